#include "claims/run_setup.h"

#include <algorithm>
#include <string>
#include <utility>

#include "expr/program/rewrite.h"
#include "hybrid/rounding_terms.h"

namespace gainsmith::claims {

namespace {

/// Whether a value keeps its bits along flows. Noise may be drawn anew within one.
bool is_still(const expr::Program& program, const hybrid::System& system) {
  return std::none_of(program.inputs.begin(), program.inputs.end(), [&](const expr::Input& input) {
    if (system.is_moving(input.name)) return true;
    const auto slot = system.slot(input.name);
    if (!slot || *slot >= system.dynamics.variables.size()) return false;
    const auto& variable = system.dynamics.variables[*slot];
    return variable.kind == model::Dynamics::VariableKind::noise &&
           system.noise[variable.of].every.has_value();
  });
}

/// Adds a claim that is stated and its functions: its programs, with the variable for its cost, and
/// the terms of what is compared with a bound.
void add_claim(const Claim& claim, RunSetup& setup) {
  JudgedClaim judged;
  judged.name = claim.name;
  judged.kind = claim.kind;
  judged.after = claim.after;
  judged.over = claim.over;
  judged.tolerance = claim.tolerance;
  judged.always = claim.always;
  judged.value = static_cast<int>(setup.functions.size());
  judged.is_still = is_still(claim.value, setup.system);
  const auto add = [&](expr::Program program, bool at_ends) {
    const auto at = static_cast<int>(setup.functions.size());
    setup.functions.push_back(std::move(program));
    setup.first_of_claim.push_back(judged.value);
    setup.at_ends.push_back(at_ends);
    return at;
  };
  using Kind = model::ClaimKind;
  add(claim.value, claim.kind == Kind::shrinks || claim.kind == Kind::cost);
  if (claim.kind == Kind::cost) {
    const std::string cost = model::cost_name(claim.name);
    judged.cost = add(expr::input_program(cost, {}), false);
    setup.costs.push_back(
        {setup.layout.slots[*setup.layout.slot(cost)].offset, claim.flow_cost, claim.jump_cost});
  }
  if (claim.factor) judged.factor = add(*claim.factor, true);
  if (claim.bound) {
    judged.bound = add(*claim.bound, true);
    judged.terms = add(hybrid::absolute_terms(claim.value), false);
  }
  setup.judged.push_back(std::move(judged));
}

/// Where along flows the value of a claim is sampled besides.
void add_sample_points(const JudgedClaim& claim, RunSetup& setup) {
  const auto value = static_cast<std::size_t>(claim.value);
  if (claim.after > 0) setup.sample_points.times.push_back(claim.after);
  using Kind = model::ClaimKind;
  // The others ask for the value at the start, and at the end.
  const bool along =
      claim.kind == Kind::nonincreasing || claim.kind == Kind::below || claim.kind == Kind::above;
  if (claim.over || !along) return;
  setup.sample_points.along.push_back(value);
  const bool above = claim.kind == Kind::above;
  if (above || claim.kind == Kind::below)
    setup.sample_points.peaks.push_back({value, above ? -1.0 : 1.0, claim.after});
  if (claim.kind == Kind::nonincreasing && !claim.is_still)
    setup.sample_points.falling.push_back({value, claim.after});
}

}  // namespace

std::unique_ptr<const RunSetup> make_run_setup(model::RunTexts texts,
                                               const std::vector<hybrid::GivenRun>* given) {
  auto setup = std::make_unique<RunSetup>();
  setup->system = hybrid::make_system(texts.dynamics, texts.stated.values);
  if (texts.in_31_digits)
    setup->system.in_31_digits = [in_31_digits = texts.in_31_digits,
                                  &constants = setup->system.constants] {
      return in_31_digits(constants);
    };
  setup->layout = hybrid::layout_of(texts.dynamics);
  setup->scenario = hybrid::make_scenario(texts.campaign, setup->system);
  setup->scenario.differences = texts.differences;
  setup->scenario.given = given;
  if (given != nullptr)
    for (const hybrid::GivenRun& run : *given)
      hybrid::check_given(run, setup->system, setup->scenario);
  setup->claims = claims_of(texts, setup->system, setup->scenario.horizon);
  setup->texts = std::move(texts);
  setup->constants = rounded_once(setup->system.constants);
  for (const Claim& claim : setup->claims) {
    if (!claim.stated()) continue;
    add_claim(claim, *setup);
    add_sample_points(setup->judged.back(), *setup);
  }
  return setup;
}

simulate::Accuracy RunSetup::accuracy(double usual, double factor) const {
  simulate::Accuracy result{usual, usual};
  if (const auto& asked = texts.campaign.accuracy) {
    result.relative = asked->relative.value_or(usual);
    result.absolute = asked->absolute.value_or(result.relative);
    if (!asked->states.empty()) result.absolute_of.setConstant(system.size, result.absolute);
    for (const auto& [state, absolute] : asked->states) {
      const hybrid::Slot& slot = layout.slots[state];
      result.absolute_of.segment(slot.offset, slot.shape.size()).setConstant(absolute);
    }
  }
  return factor == 1 ? result : result.times(factor);
}

}  // namespace gainsmith::claims
