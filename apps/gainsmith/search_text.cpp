#include "gainsmith/search_text.h"

#include <fmt/format.h>
#include <cmath>

#include "base/known_digits.h"
#include "base/number.h"

namespace gainsmith::app {

namespace {

constexpr int kDigits = 9;

/// " at delta = 0.12, eta = 0.3": where a bracket holds when other scalars were searched too.
std::string place_text(const model::Gains& gains) {
  std::string text;
  for (const std::string& name : gains.search->over)
    text += (text.empty() ? " at " : ", ") + name + " = " + brief(gains.searched.at(name), kDigits);
  return text;
}

/// The no end of a bracket.
std::string beyond_text(const model::Gains& gains) {
  const model::SearchRecord& search = *gains.search;
  std::string text;
  if (search.beyond) {
    text += fmt::format("            {} is infeasible", brief(*search.beyond, kDigits));
    if (const auto& certificate = search.certificate)
      text += model::limits_of(*certificate) + " by a checked certificate";
    text += place_text(gains) + "\n";
  }
  if (!search.open.empty())
    text += fmt::format("            undecided or refused from {} to {}\n",
                        brief(search.open[0], kDigits), brief(search.open[1], kDigits));
  return text;
}

std::string breaks_text(const model::SearchRecord& search) {
  if (search.breaks.empty()) return "";
  std::string values;
  for (const double value : search.breaks)
    values += (values.empty() ? "" : ", ") + brief(value, kDigits);
  return fmt::format(
      "            NOT MONOTONE: infeasible{} at {} as well; other boundaries may lie between "
      "the values tried\n",
      search.certificate ? model::limits_of(*search.certificate) : "", values);
}

std::string ends_text(const model::SearchRecord& search) {
  std::string text;
  for (const std::string& name : search.at_end)
    text += fmt::format(
        "            {} was found at an end of its range: a wider one may do better\n", name);
  return text;
}

std::string refinement_text(const model::SearchRecord& search) {
  if (!search.joint_refinement) return "";
  const model::RefinementRecord& refinement = *search.joint_refinement;
  const std::string after =
      refinement.after ? brief(*refinement.after, kDigits) : std::string("no value");
  return fmt::format("            joint refinement: {} before, {} after: {} ({})\n",
                     brief(refinement.before, kDigits), after,
                     refinement.kept ? "kept" : "not kept", refinement.cause);
}

}  // namespace

std::string search_text(const model::Gains& gains) {
  if (!gains.search) return "";
  const model::SearchRecord& search = *gains.search;
  const bool bracket =
      search.figure.starts_with("largest ") || search.figure.starts_with("smallest ");
  std::string text;
  if (search.error && std::isinf(*search.error))
    text = fmt::format("search      {}: not known, as its runs are uncertain at the best point\n",
                       search.figure);
  else if (search.value)
    text = fmt::format("search      {} = {}{}\n", search.figure,
                       brief(*search.value, kDigits, search.error.value_or(0)),
                       bracket ? " is feasible, every margin recomputed" : "");
  else
    text = fmt::format("search      {}: nothing feasible was found\n", search.figure);
  if (bracket && search.value && !search.beyond && search.open.empty())
    text += "            that is the end of the range: the limit lies beyond it\n";
  text += beyond_text(gains) + breaks_text(search) + ends_text(search) + refinement_text(search);
  return text + fmt::format("            {} evaluations, {} feasible{}\n", search.evaluations,
                            search.feasible, search.finished ? "" : "; STOPPED EARLY");
}

}  // namespace gainsmith::app
