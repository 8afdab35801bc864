#include "verify/setup.h"

#include <utility>

#include "hybrid/exact_values.h"

namespace gainsmith::verify {

namespace {

using Wide = numbers::MatrixOf<Decimal100>;

std::vector<const LinkedClaim*> stated_claims(const Setup& setup) {
  std::vector<const LinkedClaim*> stated;
  for (const LinkedClaim& claim : setup.claims)
    if (claim.stated()) stated.push_back(&claim);
  return stated;
}

/// The functions of the claims, in the order in which judged_claims takes them back.
std::vector<expr::Program> functions_of(const Setup& setup) {
  std::vector<expr::Program> functions;
  for (const LinkedClaim* claim : stated_claims(setup)) {
    functions.push_back(claim->value);
    for (const auto* part : {&claim->flow_cost, &claim->jump_cost, &claim->factor, &claim->bound})
      if (*part) functions.push_back(**part);
  }
  return functions;
}

/// Of each stated claim, the coordinate that is the integral of its flow cost along flows that are
/// integrated; none where there is no such cost.
std::vector<std::optional<Eigen::Index>> add_integrals(Setup& setup) {
  std::vector<std::optional<Eigen::Index>> added;
  std::size_t next = 0;
  for (const LinkedClaim* claim : stated_claims(setup)) {
    ++next;  // the value
    added.emplace_back();
    if (claim->flow_cost) {
      const expr::Program& cost = setup.coordinates.functions[next++];
      if (!setup.steps)
        added.back() = hybrid::add_integral(setup.coordinates, "integral of " + claim->name, cost);
    }
    next += static_cast<std::size_t>(claim->jump_cost.has_value()) +
            static_cast<std::size_t>(claim->factor.has_value()) +
            static_cast<std::size_t>(claim->bound.has_value());
  }
  return added;
}

void add_judged_claims(Setup& setup, std::vector<Wide>& forms) {
  const auto integrals = add_integrals(setup);
  auto accumulated = integrals.begin();
  std::size_t next = 0;
  const auto take = [&] {
    return make_function(setup.coordinates.functions[next++], setup.coordinates);
  };
  for (const LinkedClaim* claim : stated_claims(setup)) {
    JudgedClaim judged;
    judged.name = claim->name;
    judged.kind = claim->kind;
    judged.value = take();
    if (claim->flow_cost) judged.flow_cost = take();
    if (claim->jump_cost) judged.jump_cost = take();
    if (claim->factor) judged.factor = take();
    if (claim->bound) judged.bound = take();
    judged.after = claim->after;
    judged.over = claim->over;
    const Eigen::Index n = setup.coordinates.layout.size;
    judged.accumulated = *accumulated++;
    if (setup.steps && judged.flow_cost && judged.flow_cost->is_form()) {
      judged.integral = forms.size();
      forms.push_back(judged.flow_cost->parts.empty() ? Wide(Wide::Zero(n + 1, n + 1))
                                                      : judged.flow_cost->parts.front().matrix);
    }
    setup.judged.push_back(std::move(judged));
  }
}

/// Costs must be quadratic: their integrals are a part of the flow.
void add_shared_flows(Setup& setup) {
  std::vector<Eigen::Index> integrals;
  for (const JudgedClaim& claim : setup.judged) {
    if (!claim.accumulated) continue;
    if (!claim.flow_cost->quadratic) return;
    integrals.push_back(*claim.accumulated);
  }
  setup.shared = std::make_unique<hybrid::SharedFlows>(setup.system, setup.scenario,
                                                       setup.coordinates, integrals);
}

std::unique_ptr<const Setup> setup_of(std::unique_ptr<const EventSetup> events) {
  auto setup = std::make_unique<Setup>();
  setup->scenario.horizon = events->scenario.horizon;
  setup->claims = events->claims;
  setup->judged = events->judged;
  setup->events = std::move(events);
  return setup;
}

}  // namespace

std::unique_ptr<const Setup> make_setup(const model::Instance& instance,
                                        const model::Gains& gains) {
  const model::Design& design = *instance.design;
  if (design.dynamics) return setup_of(make_event_setup(instance, gains));
  hybrid::System system = hybrid::make_system(instance, gains);
  hybrid::Scenario scenario = hybrid::make_scenario(design, system);
  std::optional<hybrid::FlowSteps> steps;
  if (system.flow) steps = hybrid::make_steps(system);
  std::vector<LinkedClaim> claims = link_claims(design, system);
  check_times(design, claims, scenario.horizon);
  auto setup = std::make_unique<Setup>(Setup{std::move(system),
                                             std::move(scenario),
                                             std::move(steps),
                                             std::move(claims),
                                             {},
                                             {},
                                             {},
                                             {},
                                             {},
                                             {}});
  setup->coordinates = hybrid::make_coordinates(
      setup->system, hybrid::exact_values(instance, setup->system, gains), functions_of(*setup));
  std::vector<Wide> forms;
  add_judged_claims(*setup, forms);
  if (!setup->steps) add_shared_flows(*setup);
  std::optional<hybrid::ExactSteps> exact;
  if (setup->steps) exact = hybrid::exact_steps(setup->coordinates, *setup->steps, forms);
  setup->narrow = std::make_unique<hybrid::BoundedSystem<double>>(setup->coordinates, exact);
  if (exact)
    setup->wide = std::make_unique<hybrid::BoundedSystem<DoubleDouble>>(setup->coordinates, exact);
  return setup;
}

}  // namespace gainsmith::verify
