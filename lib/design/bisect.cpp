#include "design/bisect.h"

#include <map>
#include <utility>

#include "base/number.h"
#include "design/synthesize.h"

namespace gainsmith::design {

namespace {

search::Answer answer_of(model::Verdict verdict) {
  switch (verdict) {
    case model::Verdict::yes:
      return search::Answer::yes;
    case model::Verdict::no:
      return search::Answer::no;
    case model::Verdict::undecided:
      break;
  }
  return search::Answer::undecided;
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

/// What is said when no value is feasible. That each value asked is proved infeasible proves
/// nothing of those between, so the easiest end speaks for the whole only where feasibility is
/// monotone.
std::string nothing_found(const search::Bisection& found, const BisectChoices& choices) {
  std::size_t proved = 0;
  for (const search::Sample& sample : found.samples)
    proved += sample.answer == search::Answer::no ? 1U : 0U;
  return "no feasible " + choices.scalar.name + " in [" + brief(choices.scalar.axis.low) + ", " +
         brief(choices.scalar.axis.high) + "]: " + std::to_string(proved) + " of the " +
         std::to_string(found.samples.size()) + " values tried are proved infeasible";
}

}  // namespace

model::Gains synthesize_at(const model::Problem& problem, const model::Overrides& overrides,
                           const sdp::Options& solver) {
  return synthesize(model::make_instance(problem, overrides), solver);
}

BisectResult bisect(const model::Problem& problem, const model::Overrides& fixed,
                    const BisectChoices& choices, const sdp::Options& solver) {
  std::map<double, model::Gains> tried;
  const auto question = [&](double value) {
    model::Overrides overrides = fixed;
    overrides[choices.scalar.name] = value;
    model::Gains gains = synthesize_at(problem, overrides, solver);
    const search::Answer answer = answer_of(gains.verdict);
    tried.insert_or_assign(value, std::move(gains));
    return answer;
  };
  search::BisectOptions options;
  options.largest = choices.largest;
  options.tolerance = choices.tolerance;
  options.guess = choices.guess;
  options.interrupted = solver.interrupted;
  BisectResult result;
  result.found = search::bisect(question, choices.scalar.axis, options);
  if (tried.empty()) return result;
  const double easiest = choices.largest ? tried.begin()->first : tried.rbegin()->first;
  result.gains = tried.at(result.found.yes.value_or(easiest));
  result.gains.search = record_of(result.found, choices);
  if (!result.found.yes) result.gains.solver.message = nothing_found(result.found, choices);
  if (result.found.no) result.gains.search->certificate = tried.at(*result.found.no).certificate;
  return result;
}

}  // namespace gainsmith::design
