#include "verify/event_setup.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "base/number.h"
#include "bind/stated.h"
#include "model/stated.h"
#include "verify/text_ball.h"

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

/// A state whose rate is the flow cost of a claim.
void add_integral(const model::Design::Claim& claim, model::Dynamics& dynamics) {
  model::Dynamics::Variable variable;
  variable.name = integral_name(claim.name);
  variable.start = {zero(), claim.place, "0"};
  variable.place = claim.place;
  dynamics.flow.push_back({dynamics.variables.size(), *claim.flow_cost, claim.place});
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
bool is_still(const expr::Program& program, const hybrid::EventSystem& system) {
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
    for (const LinkedClaim& claim : setup_.claims) {
      if (!claim.stated()) continue;
      JudgedClaim judged;
      judged.name = claim.name;
      judged.kind = claim.kind;
      judged.after = claim.after;
      first_ = static_cast<int>(setup_.functions.size());
      judged.looked_for = first_;
      judged.over = claim.over;
      Plan plan{std::move(judged), add(claim.value), {}};
      if (claim.flow_cost) plan.parts[0] = add_integral_of(claim);
      if (claim.jump_cost) plan.parts[1] = add(*claim.jump_cost);
      if (claim.factor) plan.parts[2] = add(*claim.factor);
      if (claim.bound) {
        plan.parts[3] = add(*claim.bound);
        plan.parts[4] = add(hybrid::absolute_terms(claim.value));
      }
      add_looks(claim, plan.value);
      plans_.push_back(std::move(plan));
    }
    for (Plan& plan : plans_) {
      JudgedClaim& judged = plan.judged;
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
    JudgedClaim judged;
    std::size_t value;
    std::array<std::optional<std::size_t>, 5> parts;
  };

  /// Where along flows the value of a claim is looked at besides.
  void add_looks(const LinkedClaim& claim, std::size_t value) {
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

  std::size_t add_integral_of(const LinkedClaim& claim) {
    const std::string name = integral_name(claim.name);
    return add(input_of(name));
  }

  std::size_t add(const expr::Program& program) {
    const std::size_t at = setup_.functions.size();
    const std::string name = "value_" + std::to_string(at);
    setup_.functions.push_back(program);
    setup_.first_of_claim.push_back(first_);
    hybrid::Coordinates& coordinates = setup_.coordinates;
    coordinates.layout.slots.push_back({name, {}, static_cast<Index>(at)});
    coordinates.layout.size = static_cast<Index>(at) + 1;
    const expr::Program own = input_of(name);
    const bool still = is_still(program, setup_.system);
    coordinates.list.push_back({own, still ? std::nullopt : std::optional(own), own, false});
    return at;
  }

  JudgedFunction function(std::size_t at) const {
    return make_function(input_of("value_" + std::to_string(at)), setup_.coordinates);
  }

  EventSetup& setup_;
  std::vector<Plan> plans_;
  int first_ = 0;  ///< function of the claim at hand
};

}  // namespace

std::unique_ptr<const EventSetup> make_event_setup(const model::Instance& instance,
                                                   const model::Gains& gains) {
  const model::Design& design = *instance.design;
  model::Dynamics dynamics = *design.dynamics;
  for (const model::Design::Claim& claim : design.claims)
    if (claim.flow_cost) add_integral(claim, dynamics);
  model::Stated stated = bind::state(instance, gains);
  auto setup = std::make_unique<EventSetup>();
  setup->flow = dynamics.flow;
  setup->system =
      hybrid::make_event_system(dynamics, std::move(stated.values), std::move(stated.bodies));
  setup->layout = setup->system.layout;
  setup->layout.slots.resize(dynamics.variables.size());
  setup->layout.size = setup->system.size;
  setup->asked = design.campaign.accuracy;
  setup->scenario = hybrid::make_event_scenario(design.campaign, setup->system);
  setup->claims = link_claims(design, setup->system);
  check_times(design, setup->claims, setup->scenario.horizon);
  setup->constants = rounded_once(setup->system.constants);
  setup->coordinates.affine = false;
  Functions(*setup).add_all();
  setup->narrow = std::make_unique<hybrid::BoundedSystem<double>>(setup->coordinates, std::nullopt);
  return setup;
}

hybrid::Accuracy EventSetup::accuracy(double usual, double factor) const {
  hybrid::Accuracy result{usual, usual};
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
