#include "gainsmith/explain_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/number.h"
#include "gainsmith/output.h"
#include "gainsmith/summary.h"

namespace gainsmith::app {

namespace {

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  return text;
}

/// The value with the decimals that its bracket settles, and at least three, rounded to the
/// feasible side.
std::string settled(const design::Reach& reach) {
  const double value = *reach.feasible;
  const double width = reach.beyond ? std::abs(*reach.beyond - value) : 0;
  if (!(width > 0) || value == 0) return brief(value, 10);
  const double digits = std::floor(std::log10(std::abs(value))) - 2;
  const double unit = std::pow(10.0, std::min(std::ceil(std::log10(width)), digits));
  const double steps = value / unit;
  const double rounded = unit * (reach.at_most ? std::floor(steps) : std::ceil(steps));
  return brief(rounded, 10);
}

std::string reach_text(const design::Reach& reach) {
  return fmt::format("{} at {} {}", reach.name, reach.at_most ? "most" : "least", settled(reach));
}

io::Json side_of(const design::Reach& reach) {
  if (!reach.feasible) return nullptr;
  return reach.at_most ? "at most" : "at least";
}

std::string negotiable_text(const design::Reach& reach) {
  if (!reach.feasible)
    return fmt::format("negotiable  {} does not help: nothing feasible was found in its range\n",
                       reach.name);
  const std::string beyond = reach.beyond ? "; " + brief(*reach.beyond, 10) + " is excluded" +
                                                model::limits_of(*reach.certificate)
                                          : "";
  return fmt::format("negotiable  {} (it is {}{})\n", reach_text(reach), brief(reach.value),
                     beyond);
}

std::string conflict_statement(const design::Conflict& conflict) {
  if (conflict.gain_bound)
    return "the inequalities hold together, but not within the gain bound; raise "
           "synthesis.gain_bound";
  const std::string limits = (conflict.within_gain_bound ? " within the gain bound" : "") +
                             model::limits_of(conflict.certificate);
  if (conflict.names.size() == 1) return conflict.names.front() + " cannot hold" + limits;
  return listed(conflict.names) + " cannot hold together" + limits;
}

std::string certificate_brief(const model::CertificateRecord& certificate) {
  if (certificate.exact) return "exact";
  return "excludes every solution (relative error " +
         brief(certificate.backward_error, 2) + ")";
}

std::string conflict_text(const design::Conflict& conflict) {
  std::string text = "conflict    " + conflict_statement(conflict) + "\n";
  if (conflict.gain_bound) return text;
  text +=
      "            certificate of these alone: " + certificate_brief(conflict.certificate) + "\n";
  if (conflict.undecided.empty())
    return text + "            without any one of them the others can be satisfied\n";
  return text + fmt::format("            whether {} {} needed is undecided\n",
                            listed(conflict.undecided),
                            conflict.undecided.size() == 1 ? "is" : "are");
}

std::string relaxations_text(const std::vector<design::Relaxation>& relaxations) {
  if (relaxations.empty()) return "";
  std::size_t width = 10;
  for (const auto& relaxation : relaxations) width = std::max(width, relaxation.name.size());
  std::string text = fmt::format("{:<{}}  {:>14}  {:>14}  {:>10}\n", "relax by", width, "it alone",
                                 "all together", "of scale");
  const auto number = [](const std::optional<double>& value, bool at_most, const char* none) {
    if (!value) return std::string(none);
    return (at_most && *value > 0 ? "at most " : "") + brief(*value, 4);
  };
  for (const auto& relaxation : relaxations)
    text += fmt::format("{:<{}}  {:>14}  {:>14}  {:>10}\n", relaxation.name, width,
                        number(relaxation.alone, relaxation.alone_at_most,
                               relaxation.alone_undecided ? "undecided" : "does not help"),
                        number(relaxation.together, relaxation.together_at_most, "undecided"),
                        brief(relaxation.scale, 3));
  return text;
}

}  // namespace

std::string explanation_line(const design::Conflict& conflict,
                             const std::vector<design::Reach>& reaches) {
  std::string text = conflict_statement(conflict);
  std::string ways;
  for (const design::Reach& reach : reaches)
    if (reach.feasible) ways += (ways.empty() ? "" : ", or ") + reach_text(reach);
  return text + (ways.empty() ? "" : "; " + ways + " would do");
}

std::string explanation_text(const design::Explanation& explanation) {
  std::string text = fmt::format("problem     {}\nverdict     {}\n", explanation.gains.problem_name,
                                 verdict_line(explanation.gains));
  if (!explanation.conflict) text += message_lines(explanation.gains);
  if (explanation.conflict) text += conflict_text(*explanation.conflict);
  text += relaxations_text(explanation.relaxations);
  for (const design::Reach& reach : explanation.reaches) text += negotiable_text(reach);
  return text;
}

io::Json explanation_json(const design::Explanation& explanation) {
  const auto number = [](const std::optional<double>& value) {
    return value ? io::Json(*value) : io::Json();
  };
  io::Json document = {{"problem", explanation.gains.problem_name},
                       {"verdict", to_string(explanation.gains.verdict)},
                       {"conflict", nullptr},
                       {"relaxations", io::Json::array()},
                       {"negotiable", io::Json::array()}};
  if (const auto& conflict = explanation.conflict)
    document["conflict"] = {{"requirements", conflict->names},
                            {"undecided", conflict->undecided},
                            {"gain_bound", conflict->gain_bound},
                            {"within_gain_bound", conflict->within_gain_bound},
                            {"exact", conflict->certificate.exact},
                            {"about", conflict->certificate.about},
                            {"backward_error", conflict->certificate.backward_error}};
  for (const auto& relaxation : explanation.relaxations)
    document["relaxations"].push_back({{"requirement", relaxation.name},
                                       {"scale", relaxation.scale},
                                       {"alone", number(relaxation.alone)},
                                       {"alone_undecided", relaxation.alone_undecided},
                                       {"alone_at_most", relaxation.alone_at_most},
                                       {"together", number(relaxation.together)},
                                       {"together_at_most", relaxation.together_at_most}});
  for (const auto& reach : explanation.reaches)
    document["negotiable"].push_back(
        {{"scalar", reach.name},
         {"value", reach.value},
         {"side", side_of(reach)},
         {"feasible", number(reach.feasible)},
         {"beyond", number(reach.beyond)},
         {"beyond_about", reach.certificate ? io::Json(reach.certificate->about) : io::Json()}});
  return document;
}

}  // namespace gainsmith::app
