#include "design/bisect.h"

#include <algorithm>
#include <map>
#include <utility>

#include "base/number.h"
#include "base/stop.h"
#include "design/hautus.h"
#include "design/synthesize.h"

namespace gainsmith::design {

namespace {

/// A value that is infeasible for the hull or the vertex test only counts as infeasible; what the
/// certificate is limited to is said.
search::Answer answer_of(const model::Gains& gains) {
  if (gains.verdict == model::Verdict::yes) return search::Answer::yes;
  const bool infeasible = gains.verdict == model::Verdict::no || gains.certificate;
  return infeasible ? search::Answer::no : search::Answer::undecided;
}

/// The bracket in the words of the gain file.
model::SearchRecord record_of(const search::Bisection& found, const BisectChoices& choices) {
  model::SearchRecord record;
  record.figure = (choices.largest ? "largest " : "smallest ") + choices.scalar.name;
  record.value = found.yes;
  record.beyond = found.no;
  if (found.open) record.open = {found.open->near_yes, found.open->near_no};
  record.breaks = found.breaks;
  record.evaluations = static_cast<int>(found.samples.size());
  for (const search::Sample& sample : found.samples)
    record.feasible += sample.answer == search::Answer::yes ? 1 : 0;
  record.finished = found.finished;
  return record;
}

/// The values with an answer: "0, 0.5, 1".
std::string values_with(const search::Bisection& found, search::Answer answer) {
  std::string values;
  for (const search::Sample& sample : found.samples)
    if (sample.answer == answer) values += (values.empty() ? "" : ", ") + brief(sample.value);
  return values;
}

/// What is said when no value is feasible: nothing of those that were not tried.
/// `limits`: what the certificates are limited to (model::limits_of). `held`: scalars that a search
/// might have moved, as text.
std::string nothing_found(const search::Bisection& found, const BisectChoices& choices,
                          const std::string& limits, const std::string& held) {
  std::string text = "no feasible " + choices.scalar.name + " among the " +
                     std::to_string(found.samples.size()) + " values tried in [" +
                     brief(choices.scalar.axis.low) + ", " + brief(choices.scalar.axis.high) + "]" +
                     (held.empty() ? "" : " at " + held);
  const bool all = std::all_of(found.samples.begin(), found.samples.end(), [](const auto& sample) {
    return sample.answer == search::Answer::no;
  });
  const std::string also = choices.also ? " or by violated claims" : "";
  if (all)
    return text + "; each is infeasible by a certificate" + limits + also +
           ", which says nothing of those between";
  const std::string infeasible = values_with(found, search::Answer::no);
  const std::string refused = values_with(found, search::Answer::refused);
  if (!infeasible.empty())
    text += "; those at " + infeasible + " are infeasible by certificates" + limits + also;
  if (!refused.empty()) text += "; those at " + refused + " are refused by the assumptions";
  return text;
}

/// The scalars that the caller sets.
std::vector<std::string> set_names(const BisectChoices& choices, const model::Overrides& fixed) {
  std::vector<std::string> names = {choices.scalar.name};
  for (const auto& [name, value] : fixed) names.push_back(name);
  return names;
}

std::string hidden_mode_note(const model::Instance& instance) {
  const std::string hidden = hidden_mode_text(instance);
  return hidden.empty() ? "" : "; " + hidden;
}

/// A result that is not feasible as that of a whole search.
void set_undecided(model::Gains& gains, const std::string& message) {
  gains.verdict = model::Verdict::undecided;
  gains.solver.status = "undecided";
  gains.solver.message = message;
  gains.certificate.reset();
}

}  // namespace

BisectResult bisect(const model::Instance& own, const model::Overrides& fixed,
                    const BisectChoices& choices, const sdp::Options& solver) {
  std::map<double, model::Gains> tried;
  std::optional<InputError> refusal;
  const auto overrides_at = [&](double value) {
    model::Overrides overrides = {{choices.scalar.name, value}};
    overrides.insert(fixed.begin(), fixed.end());
    overrides.insert(own.overrides.begin(), own.overrides.end());
    return overrides;
  };
  // refused: the assumptions of the method exclude the value.
  const auto question = [&](double value) {
    const model::Overrides overrides = overrides_at(value);
    try {
      model::Gains gains =
          synthesize_at(own.design, overrides, solver, std::max(choices.depth, Depth::verdict));
      if (gains.verdict == model::Verdict::undecided) check_stop();
      search::Answer answer = answer_of(gains);
      if (answer == search::Answer::yes && choices.also) answer = choices.also(gains);
      tried.insert_or_assign(value, std::move(gains));
      return answer;
    } catch (const InputError& error) {
      if (!refusal) refusal = error;
      return search::Answer::refused;
    }
  };
  search::BisectOptions options;
  options.largest = choices.largest;
  options.tolerance = choices.tolerance;
  options.known = model::scalar_named(own, choices.scalar.name);
  options.guess = choices.guess;
  BisectResult result;
  result.found = search::bisect(question, choices.scalar.axis, options);
  // The ends of a bracket alone are told of in full.
  // In the search itself margins are computed only as far as the verdict rests on them.
  const bool in_full = choices.depth == Depth::thorough && !is_stopping();
  for (const auto& end : {result.found.yes, result.found.no}) {
    if (!end || !in_full) continue;
    model::Gains gains = synthesize_at(own.design, overrides_at(*end), solver);
    if (answer_of(gains) == answer_of(tried.at(*end))) tried.at(*end) = std::move(gains);
  }
  const Concluding concluding;
  if (tried.empty() && refusal) throw InputError(*refusal);
  if (tried.empty()) return result;
  for (const auto& [value, gains] : tried)
    if (gains.certificate && !gains.certificate->is_about_problem())
      result.limits.emplace(value, model::limits_of(*gains.certificate));
  const double easiest = choices.largest ? tried.begin()->first : tried.rbegin()->first;
  result.gains = tried.at(result.found.yes.value_or(easiest));
  result.gains.search = record_of(result.found, choices);
  if (!result.found.yes)
    set_undecided(result.gains,
                  nothing_found(result.found, choices,
                                result.limits.empty() ? "" : result.limits.begin()->second,
                                held_text(held_scalars(own, set_names(choices, fixed)))) +
                      hidden_mode_note(own));
  if (result.found.no) result.gains.search->certificate = tried.at(*result.found.no).certificate;
  return result;
}

}  // namespace gainsmith::design
