#include "verify/careful_runs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "base/number.h"
#include "bind/stated.h"
#include "claims/text_ball.h"
#include "model/stated.h"
#include "verify/error_states.h"

namespace gainsmith::verify {

namespace {

using Eigen::Index;

std::string integral_name(const std::string& claim) { return "integral of " + claim; }

expr::Program zero() {
  expr::Instruction constant;
  constant.op = expr::Op::constant;
  constant.text = "0";
  expr::Program program;
  program.code.push_back(std::move(constant));
  program.result = 0;
  return program;
}

/// A variable for the integral of the flow cost of a claim. Runs leave it as it is
/// (claims/cost_integrals.h).
void add_integral(const model::Design::Claim& claim, model::Dynamics& dynamics) {
  model::Dynamics::Variable variable;
  variable.name = integral_name(claim.name);
  variable.start = {zero(), claim.place, "0"};
  variable.place = claim.place;
  dynamics.variables.push_back(std::move(variable));
}

/// The program that is an input of this name.
expr::Program input_of(const std::string& name) {
  expr::Instruction input;
  input.op = expr::Op::input;
  input.attributes = {0};
  expr::Program program;
  program.code.push_back(std::move(input));
  program.inputs.push_back({name, {}});
  program.result = 0;
  return program;
}

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

/// The functions of the claims that are stated, and the claims over them.
class Functions {
 public:
  explicit Functions(EventSetup& setup) : setup_(setup) {}

  void add_all() {
    for (const claims::LinkedClaim& claim : setup_.claims) {
      if (!claim.stated()) continue;
      claims::JudgedClaim judged;
      judged.name = claim.name;
      judged.kind = claim.kind;
      judged.after = claim.after;
      judged.tolerance = claim.tolerance;
      first_ = static_cast<int>(setup_.functions.size());
      judged.sampled_for = first_;
      judged.over = claim.over;
      Plan plan{std::move(judged), add(claim.value), {}};
      if (claim.flow_cost) plan.parts[0] = add_integral_of(claim);
      if (claim.jump_cost) plan.parts[1] = add(*claim.jump_cost);
      if (claim.factor) plan.parts[2] = add(*claim.factor);
      if (claim.bound) {
        plan.parts[3] = add(*claim.bound);
        plan.parts[4] = add(hybrid::absolute_terms(claim.value));
      }
      add_sample_points(claim, plan.value);
      plans_.push_back(std::move(plan));
    }
    for (Plan& plan : plans_) {
      claims::JudgedClaim& judged = plan.judged;
      judged.value = function(plan.value);
      if (plan.parts[0]) {
        judged.flow_cost = function(*plan.parts[0]);
        judged.accumulated = static_cast<Index>(*plan.parts[0]);
      }
      if (plan.parts[1]) judged.jump_cost = function(*plan.parts[1]);
      if (plan.parts[2]) judged.factor = function(*plan.parts[2]);
      if (plan.parts[3]) judged.bound = function(*plan.parts[3]);
      if (plan.parts[4]) judged.terms = function(*plan.parts[4]);
      setup_.judged.push_back(std::move(judged));
    }
  }

 private:
  struct Plan {
    claims::JudgedClaim judged;
    std::size_t value;
    std::array<std::optional<std::size_t>, 5> parts;
  };

  /// Where along flows the value of a claim is looked at besides.
  void add_sample_points(const claims::LinkedClaim& claim, std::size_t value) {
    if (claim.after > 0) setup_.looks.times.push_back(claim.after);
    using Kind = model::ClaimKind;
    // The others ask for the value at the start, and at the end.
    const bool along =
        claim.kind == Kind::nonincreasing || claim.kind == Kind::below || claim.kind == Kind::above;
    if (claim.over || !along) return;
    setup_.looks.along.push_back(value);
    const bool above = claim.kind == Kind::above;
    if (above || claim.kind == Kind::below)
      setup_.looks.peaks.push_back({value, above ? -1.0 : 1.0, claim.after});
    const bool moves = setup_.coordinates.list[value].flow.has_value();
    if (claim.kind == Kind::nonincreasing && moves)
      setup_.looks.falling.push_back({value, claim.after});
  }

  std::size_t add_integral_of(const claims::LinkedClaim& claim) {
    const std::string name = integral_name(claim.name);
    const hybrid::Slot& slot = setup_.layout.slots[*setup_.system.slot(name)];
    setup_.costs.push_back({slot.offset, *claim.flow_cost});
    return add(input_of(name), false);
  }

  std::size_t add(const expr::Program& program) {
    return add(program, is_still(program, setup_.system));
  }

  /// `still`: whether it keeps its bits along flows.
  std::size_t add(const expr::Program& program, bool still) {
    const std::size_t at = setup_.functions.size();
    const std::string name = "value_" + std::to_string(at);
    setup_.functions.push_back(program);
    setup_.first_of_claim.push_back(first_);
    bounded::Coordinates& coordinates = setup_.coordinates;
    coordinates.layout.slots.push_back({name, {}, static_cast<Index>(at)});
    coordinates.layout.size = static_cast<Index>(at) + 1;
    const expr::Program own = input_of(name);
    coordinates.list.push_back({own, still ? std::nullopt : std::optional(own), own, false});
    return at;
  }

  claims::JudgedFunction function(std::size_t at) const {
    return claims::make_function(input_of("value_" + std::to_string(at)), setup_.coordinates);
  }

  EventSetup& setup_;
  std::vector<Plan> plans_;
  int first_ = 0;  ///< function of the claim at hand
};

std::vector<expr::Program> programs_of(const std::vector<claims::LinkedClaim>& claims) {
  std::vector<expr::Program> programs;
  for (const claims::LinkedClaim& claim : claims) {
    if (!claim.stated()) continue;
    programs.push_back(claim.value);
    if (claim.flow_cost) programs.push_back(*claim.flow_cost);
  }
  return programs;
}

/// The system, with its claims and where its runs start.
std::unique_ptr<EventSetup> begin(const model::Instance& instance, const model::Gains& gains) {
  const model::Design& design = *instance.design;
  model::Dynamics dynamics = *design.dynamics;
  for (const model::Design::Claim& claim : design.claims)
    if (claim.flow_cost) add_integral(claim, dynamics);
  model::Stated stated = bind::state(instance, gains);
  auto setup = std::make_unique<EventSetup>();
  setup->flow = dynamics.flow;
  setup->system = hybrid::make_system(dynamics, std::move(stated.values), std::move(stated.bodies));
  setup->asked = design.campaign.accuracy;
  setup->scenario = hybrid::make_scenario(design.campaign, setup->system);
  setup->claims = claims::link_claims(design, setup->system);
  claims::check_times(design, setup->claims, setup->scenario.horizon);
  return setup;
}

/// Whether there are errors that are states now.
bool take_errors(EventSetup& setup) {
  auto errors = ErrorStates::of(setup.system, programs_of(setup.claims));
  if (!errors) return false;
  setup.flow = errors->dynamics().flow;
  setup.system = hybrid::make_system(errors->dynamics(), std::move(setup.system.constants),
                                     std::move(setup.system.bodies));
  errors->rewrite(setup.scenario);
  for (claims::LinkedClaim& claim : setup.claims) {
    claim.value = (*errors)(claim.value);
    for (auto* part : {&claim.flow_cost, &claim.jump_cost, &claim.factor, &claim.bound})
      if (*part) *part = (*errors)(**part);
  }
  return true;
}

std::unique_ptr<const EventSetup> end(std::unique_ptr<EventSetup> setup) {
  setup->layout = setup->system.layout;
  setup->layout.slots.resize(setup->system.dynamics.variables.size());
  setup->layout.size = setup->system.size;
  setup->constants = claims::rounded_once(setup->system.constants);
  setup->coordinates.affine = false;
  Functions(*setup).add_all();
  setup->narrow =
      std::make_unique<bounded::BoundedSystem<double>>(setup->coordinates, std::nullopt);
  return setup;
}

}  // namespace

std::unique_ptr<const EventSetup> make_event_setup(const model::Instance& instance,
                                                   const model::Gains& gains) {
  return end(begin(instance, gains));
}

std::unique_ptr<const EventSetup> make_error_setup(const model::Instance& instance,
                                                   const model::Gains& gains) {
  auto setup = begin(instance, gains);
  return take_errors(*setup) ? end(std::move(setup)) : nullptr;
}

simulate::Accuracy EventSetup::accuracy(double usual, double factor) const {
  simulate::Accuracy result{usual, usual};
  if (asked) {
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
