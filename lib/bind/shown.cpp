#include "bind/shown.h"

#include <algorithm>
#include <string>
#include <vector>

#include "base/nearest.h"

namespace gainsmith::bind {

namespace {

struct Named {
  std::string name;  ///< "nominal.xh"
  expr::Shape shape;

  std::string own() const { return name.substr(name.rfind('.') + 1); }
  /// Its observer with a point; empty: of the plant.
  std::string owner() const { return name.substr(0, name.size() - own().size()); }
  bool is(const std::string& text) const { return name == text || own() == text; }
};

/// What moves.
std::vector<Named> moving(const model::Design& design) {
  std::vector<Named> all;
  for (const model::Design::State& state : design.states) all.push_back({state.name, state.shape});
  if (design.dynamics)
    for (const model::Dynamics::Signal& signal : design.dynamics->signals)
      all.push_back({signal.name, signal.value.program.shape()});
  return all;
}

/// Everything that may have a unit.
std::vector<Named> everything(const model::Design& design) {
  constexpr expr::Shape scalar{1, 1};
  std::vector<Named> all = moving(design);
  if (design.dynamics)
    for (const model::Dynamics::Variable& variable : design.dynamics->variables)
      if (variable.kind == model::Dynamics::VariableKind::measured)
        all.push_back({variable.name, variable.shape});
  for (const model::Design::Claim& claim : design.claims) all.push_back({claim.name, scalar});
  for (const model::Design::Datum& datum : design.data) all.push_back({datum.name, datum.shape});
  for (const model::Design::Datum& datum : design.parameters)
    all.push_back({datum.name, datum.shape});
  for (const model::Design::Gain& gain : design.gains) all.push_back({gain.name, gain.shape});
  all.push_back({"t", scalar});
  if (design.objective || design.quotient) all.push_back({"objective", scalar});
  return all;
}

/// All that have the name, with their observer or without. InputError where nothing has it.
std::vector<Named> find(const std::string& name, const std::vector<Named>& among,
                        const std::string& what, const Place& place) {
  std::vector<Named> found;
  std::vector<std::string> known;
  const auto add = [&](const std::string& one) {
    if (std::find(known.begin(), known.end(), one) == known.end()) known.push_back(one);
  };
  for (const Named& named : among) {
    if (named.is(name)) found.push_back(named);
    add(named.own());
  }
  for (const Named& named : among) add(named.name);
  if (found.empty())
    throw InputError(place, what + " is named '" + name + "'" + suggestion(name, known));
  return found;
}

/// One unit is for all elements.
void check(const model::UnitText& text, const std::vector<Named>& among) {
  const auto found = find(text.name, among, "units: nothing", text.place);
  const bool fits =
      text.units.size() == 1 || std::any_of(found.begin(), found.end(), [&](const Named& named) {
        return static_cast<std::size_t>(named.shape.size()) == text.units.size();
      });
  if (!fits)
    throw InputError(text.place, "units: " + text.name + " is " + to_string(found.front().shape) +
                                     "; expected one unit, or one for each element, not " +
                                     std::to_string(text.units.size()));
}

/// P of an estimate xh: n x n for n x 1, both of the same observer.
void check(const model::CovarianceText& text, const std::vector<Named>& among) {
  const std::string what = "covariance: no state or signal";
  const auto estimates = find(text.estimate, among, what, text.place);
  const auto covariances = find(text.covariance, among, what, text.covariance_place);
  const auto is_of = [](const Named& covariance, const Named& estimate) {
    const std::string a = covariance.owner(), b = estimate.owner();
    const int n = estimate.shape.rows;
    return a == b && estimate.shape.cols == 1 && covariance.shape == expr::Shape{n, n};
  };
  for (const Named& estimate : estimates)
    for (const Named& covariance : covariances)
      if (is_of(covariance, estimate)) return;
  throw InputError(text.covariance_place,
                   "covariance: '" + text.covariance + "', " +
                       to_string(covariances.front().shape) + ", is none of '" + text.estimate +
                       "', " + to_string(estimates.front().shape) +
                       ": of a column with n elements it is n x n, and of the same observer");
}

}  // namespace

void check_shown(const Binding& binding) {
  const model::Problem& problem = binding.problem();
  if (problem.units.empty() && problem.covariances.empty()) return;
  const std::vector<Named> named = everything(*binding.design), moves = moving(*binding.design);
  for (const model::UnitText& text : problem.units) check(text, named);
  for (const model::CovarianceText& text : problem.covariances) check(text, moves);
}

}  // namespace gainsmith::bind
