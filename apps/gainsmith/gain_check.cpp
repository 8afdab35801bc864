#include "gainsmith/gain_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/number.h"

namespace gainsmith::app {

namespace {

std::string listed_names(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

/// What the verdict says, in one sentence.
std::string sentence(const design::GainCheck& check) {
  switch (check.verdict) {
    case model::Verdict::yes:
      if (check.margins.empty())
        return "there is no inequality: the gains are formulas of the data";
      return std::string("every inequality holds at the gains of the file, shown with ") +
             (check.own_unknowns ? "the unknowns of the file" : "unknowns that were solved anew");
    case model::Verdict::no:
      return "the inequalities do not hold at the gains of the file, with any unknowns";
    case model::Verdict::undecided:
      break;
  }
  return "whether the inequalities hold at the gains of the file is not known";
}

}  // namespace

design::GainCheck check_gains(const LoadedGains& loaded) {
  design::GainCheck check = design::check_gains(loaded.stated, loaded.gains, {});
  if (loaded.gains.is_edited)
    check.message += std::string(check.message.empty() ? "" : "; ") +
                     "gains, unknowns or multipliers are not those that were written: they do not "
                     "match proof.sha256";
  return check;
}

std::string not_shown_text(const design::GainCheck& check) { return listed_names(check.not_shown); }

std::string gain_check_text(const std::string& path, const design::GainCheck& check) {
  std::string text = fmt::format("{}: {}: {}\n", path, to_string(check.verdict), sentence(check));
  if (!check.edited.empty())
    text += "  edited      " + listed_names(check.edited) +
            ": other than the formulas give at the unknowns of the file\n";
  if (!check.not_shown.empty())
    text += "  not shown   " + not_shown_text(check) + ", with the unknowns of the file\n";
  if (!check.message.empty()) text += "  note        " + check.message + "\n";
  std::size_t width = 10;
  for (const model::Margin& margin : check.margins) width = std::max(width, margin.name.size());
  if (!check.margins.empty())
    text += fmt::format("  {:<{}}  {:>10}  {}\n", "inequality", width, "margin", "worst at");
  for (const model::Margin& margin : check.margins) {
    text += fmt::format("  {:<{}}  {:>10}  {}{}\n", margin.name, width, brief(margin.reached, 3),
                        margin.worst_point, margin.holds ? "" : "  NOT SHOWN");
  }
  return text;
}

io::Json gain_check_json(const std::string& path, const design::GainCheck& check) {
  io::Json margins = io::Json::array();
  for (const model::Margin& margin : check.margins)
    margins.push_back({{"name", margin.name},
                       {"strict", margin.strict},
                       {"holds", margin.holds},
                       {"reached", io::finite_or_null(margin.reached)},
                       {"worst_point", margin.worst_point}});
  return {{"file", path},
          {"verdict", to_string(check.verdict)},
          {"own_unknowns", check.own_unknowns},
          {"edited", check.edited},
          {"not_shown", check.not_shown},
          {"margins", std::move(margins)},
          {"message", check.message}};
}

}  // namespace gainsmith::app
