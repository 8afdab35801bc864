#include "verify/careful_runs.h"

#include <algorithm>
#include <string>
#include <utility>

#include "bounded/polynomial.h"
#include "claims/text_ball.h"

namespace gainsmith::verify {

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

/// The coordinate that is function k.
expr::Program value_program(std::size_t k) {
  return bounded::input_program("value_" + std::to_string(k), {});
}

/// A claim about a cost over the variable that holds it.
claims::Claim over_variable(claims::Claim claim) {
  if (claim.kind != model::ClaimKind::cost) return claim;
  claim.flow_cost = bounded::input_program(model::cost_name(claim.name), {});
  claim.jump_cost.reset();
  return claim;
}

/// Adds the functions of a claim: its programs, with the variable for its cost, and the terms of
/// what is compared with a bound.
void add_functions(const claims::Claim& claim, EventSetup& setup) {
  const bool has_cost = claim.kind == model::ClaimKind::cost;
  std::vector<expr::Program> programs = claims::programs_of(over_variable(claim));
  if (claim.bound) programs.push_back(hybrid::absolute_terms(claim.value));
  if (has_cost) {
    const std::size_t slot = *setup.layout.slot(model::cost_name(claim.name));
    setup.costs.push_back({setup.layout.slots[slot].offset, claim.flow_cost, claim.jump_cost});
  }
  const auto first = static_cast<int>(setup.functions.size());
  for (std::size_t k = 0; k < programs.size(); ++k) {
    const bool is_cost = has_cost && k == 1;
    const bool still = !is_cost && is_still(programs[k], setup.system);
    const expr::Program own = value_program(setup.functions.size());
    bounded::Coordinates& coordinates = setup.coordinates;
    coordinates.layout.slots.push_back({own.inputs[0].name, {}, coordinates.layout.size++});
    coordinates.list.push_back({own, still ? std::nullopt : std::optional(own), own, false});
    setup.functions.push_back(std::move(programs[k]));
    setup.first_of_claim.push_back(first);
  }
}

/// Where along flows the value of a claim, function `value`, is looked at besides.
void add_sample_points(const claims::Claim& claim, std::size_t value, EventSetup& setup) {
  if (claim.after > 0) setup.looks.times.push_back(claim.after);
  using Kind = model::ClaimKind;
  // The others ask for the value at the start, and at the end.
  const bool along =
      claim.kind == Kind::nonincreasing || claim.kind == Kind::below || claim.kind == Kind::above;
  if (claim.over || !along) return;
  setup.looks.along.push_back(value);
  const bool above = claim.kind == Kind::above;
  if (above || claim.kind == Kind::below)
    setup.looks.peaks.push_back({value, above ? -1.0 : 1.0, claim.after});
  const bool moves = setup.coordinates.list[value].flow.has_value();
  if (claim.kind == Kind::nonincreasing && moves)
    setup.looks.falling.push_back({value, claim.after});
}

/// The claims that are stated over their functions, which are all there.
std::vector<claims::JudgedClaim> judged_claims(const EventSetup& setup) {
  std::vector<claims::JudgedClaim> all;
  std::size_t k = 0;
  const auto next = [&] { return claims::make_function(value_program(k++), setup.coordinates); };
  for (const claims::Claim& claim : setup.claims) {
    if (!claim.stated()) continue;
    const auto value = static_cast<int>(k);
    claims::JudgedClaim& judged =
        all.emplace_back(claims::judged_claim(over_variable(claim), next));
    if (claim.bound) judged.terms = next();
    if (claim.kind == model::ClaimKind::cost) judged.accumulated = value + 1;
    judged.sampled_for = value;
  }
  return all;
}

}  // namespace

std::unique_ptr<const EventSetup> make_event_setup(model::RunTexts texts,
                                                   const std::vector<hybrid::GivenRun>* given) {
  auto setup = std::make_unique<EventSetup>();
  setup->system = hybrid::make_system(texts.dynamics, texts.stated.values);
  setup->layout = hybrid::layout_of(texts.dynamics);
  setup->scenario = hybrid::make_scenario(texts.campaign, setup->system);
  setup->scenario.differences = texts.differences;
  setup->scenario.given = given;
  if (given != nullptr)
    for (const hybrid::GivenRun& run : *given)
      hybrid::check_given(run, setup->system, setup->scenario);
  setup->claims = claims::claims_of(texts, setup->system, setup->scenario.horizon);
  setup->texts = std::move(texts);
  setup->constants = claims::rounded_once(setup->system.constants);
  setup->coordinates.affine = false;
  for (const claims::Claim& claim : setup->claims) {
    if (!claim.stated()) continue;
    add_functions(claim, *setup);
    add_sample_points(claim, static_cast<std::size_t>(setup->first_of_claim.back()), *setup);
  }
  setup->judged = judged_claims(*setup);
  setup->narrow =
      std::make_unique<bounded::BoundedSystem<double>>(setup->coordinates, std::nullopt);
  return setup;
}

simulate::Accuracy EventSetup::accuracy(double usual, double factor) const {
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

}  // namespace gainsmith::verify
