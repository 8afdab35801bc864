#include "verify/setup.h"

#include <algorithm>
#include <utility>

#include "hybrid/exact_values.h"

namespace gainsmith::verify {

namespace {

using Wide = numbers::MatrixOf<Decimal100>;

using StatedClaims = std::vector<const claims::LinkedClaim*>;

StatedClaims stated_claims(const std::vector<claims::LinkedClaim>& claims) {
  StatedClaims stated;
  for (const claims::LinkedClaim& claim : claims)
    if (claim.stated()) stated.push_back(&claim);
  return stated;
}

/// The functions of the claims, in the order in which judged_claims takes them back.
std::vector<expr::Program> functions_of(const StatedClaims& claims) {
  std::vector<expr::Program> functions;
  for (const claims::LinkedClaim* claim : claims) {
    functions.push_back(claim->value);
    for (const auto* part : {&claim->flow_cost, &claim->jump_cost, &claim->factor, &claim->bound})
      if (*part) functions.push_back(**part);
  }
  return functions;
}

/// By stated claim, the coordinate that is the integral of its flow cost along integrated flows;
/// none where there is no such cost.
std::vector<std::optional<Eigen::Index>> add_integrals(const StatedClaims& claims,
                                                       SampledSetup& setup) {
  std::vector<std::optional<Eigen::Index>> added;
  std::size_t next = 0;
  for (const claims::LinkedClaim* claim : claims) {
    ++next;  // the value
    added.emplace_back();
    if (claim->flow_cost) {
      const expr::Program& cost = setup.coordinates.functions[next++];
      if (!setup.steps)
        added.back() = bounded::add_integral(setup.coordinates, "integral of " + claim->name, cost);
    }
    next += static_cast<std::size_t>(claim->jump_cost.has_value()) +
            static_cast<std::size_t>(claim->factor.has_value()) +
            static_cast<std::size_t>(claim->bound.has_value());
  }
  return added;
}

void add_judged_claims(const StatedClaims& claims, SampledSetup& setup, std::vector<Wide>& forms) {
  const auto integrals = add_integrals(claims, setup);
  auto accumulated = integrals.begin();
  std::size_t next = 0;
  const auto take = [&] {
    return claims::make_function(setup.coordinates.functions[next++], setup.coordinates);
  };
  for (const claims::LinkedClaim* claim : claims) {
    claims::JudgedClaim judged;
    judged.name = claim->name;
    judged.kind = claim->kind;
    judged.value = take();
    if (claim->flow_cost) judged.flow_cost = take();
    if (claim->jump_cost) judged.jump_cost = take();
    if (claim->factor) judged.factor = take();
    if (claim->bound) judged.bound = take();
    judged.after = claim->after;
    judged.over = claim->over;
    judged.tolerance = claim->tolerance;
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

/// Whether the flow is of the kind. Costs must be quadratic: their integrals are a part of it.
bool add_clocked_flows(SampledSetup& setup, const hybrid::Scenario& scenario) {
  std::vector<Eigen::Index> integrals;
  for (const claims::JudgedClaim& claim : setup.judged) {
    if (!claim.accumulated) continue;
    if (!claim.flow_cost->quadratic) return false;
    integrals.push_back(*claim.accumulated);
  }
  setup.flows = std::make_unique<bounded::ClockedFlows>(*setup.system, scenario, setup.coordinates,
                                                        integrals);
  return setup.flows->to(kAccuracyOfMany) != nullptr;
}

/// None when the dynamics are of another kind.
std::unique_ptr<const SampledSetup> make_sampled_setup(const model::Instance& instance,
                                                       const model::Gains& gains,
                                                       const EventSetup& events) {
  auto setup = std::make_unique<SampledSetup>();
  setup->system = bounded::make_sampled_system(events.system);
  if (!setup->system) return nullptr;
  const bounded::SampledSystem& system = *setup->system;
  if (system.flow) setup->steps.emplace(*system.flow, system.longest, system.flow_place);
  const StatedClaims stated = stated_claims(events.claims);
  setup->coordinates = bounded::make_coordinates(
      system, hybrid::exact_values(instance, system.constants(), gains), functions_of(stated));
  std::vector<Wide> forms;
  add_judged_claims(stated, *setup, forms);
  if (!setup->steps && !add_clocked_flows(*setup, events.scenario)) return nullptr;
  std::optional<bounded::ExactSteps> exact;
  if (setup->steps) exact = bounded::exact_steps(setup->coordinates, *setup->steps, forms);
  setup->narrow = std::make_unique<bounded::BoundedSystem<double>>(setup->coordinates, exact);
  if (exact)
    setup->wide = std::make_unique<bounded::BoundedSystem<DoubleDouble>>(setup->coordinates, exact);
  return setup;
}

/// Of no claim that only the careful run understands: over an event, or with a tolerance of a bound,
/// which may be 0.
bool is_of_samples(const model::Design& design) {
  return std::none_of(design.claims.begin(), design.claims.end(),
                      [](const model::Design::Claim& claim) {
                        return claim.over.has_value() || (claim.bound && claim.tolerance > 0);
                      });
}

}  // namespace

std::unique_ptr<const Setup> make_setup(const model::Instance& instance,
                                        const model::Gains& gains) {
  auto setup = std::make_unique<Setup>();
  setup->events = make_event_setup(instance, gains);
  if (!instance.design->campaign.accuracy && is_of_samples(*instance.design))
    setup->sampled = make_sampled_setup(instance, gains, *setup->events);
  if (setup->sampled) return setup;
  setup->errors = make_error_setup(instance, gains);
  return setup;
}

}  // namespace gainsmith::verify
