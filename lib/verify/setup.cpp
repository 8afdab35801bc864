#include "verify/setup.h"

#include <algorithm>
#include <utility>

#include "bind/stated.h"
#include "hybrid/exact_values.h"
#include "verify/error_states.h"

namespace gainsmith::verify {

namespace {

using Wide = numbers::MatrixOf<Decimal100>;

/// The programs of the claims that are stated.
std::vector<expr::Program> functions_of(const std::vector<claims::Claim>& claims) {
  std::vector<expr::Program> functions;
  for (const claims::Claim& claim : claims)
    if (claim.stated())
      for (expr::Program& program : claims::programs_of(claim))
        functions.push_back(std::move(program));
  return functions;
}

/// Along flows that are integrated the integral of each flow cost is a coordinate.
void add_integrals(const std::vector<claims::Claim>& claims, bounded::Coordinates& coordinates) {
  std::size_t next = 0;
  for (const claims::Claim& claim : claims) {
    if (!claim.stated()) continue;
    if (claim.flow_cost)
      bounded::add_integral(coordinates, model::cost_name(claim.name),
                            coordinates.functions[next + 1]);
    next += claims::programs_of(claim).size();
  }
}

/// `forms`: gets the quadratic forms whose integrals the claims ask of exact steps.
void add_judged_claims(const std::vector<claims::Claim>& claims, SampledSetup& setup,
                       std::vector<Wide>& forms) {
  const bounded::Coordinates& coordinates = setup.coordinates;
  std::size_t k = 0;
  const auto next = [&] { return claims::make_function(coordinates.functions[k++], coordinates); };
  for (const claims::Claim& claim : claims) {
    if (!claim.stated()) continue;
    claims::JudgedClaim& judged = setup.judged.emplace_back(claims::judged_claim(claim, next));
    const auto integral = coordinates.layout.slot(model::cost_name(claim.name));
    if (integral) judged.accumulated = coordinates.layout.slots[*integral].offset;
    if (!setup.steps || !judged.flow_cost || !judged.flow_cost->is_form()) continue;
    const Eigen::Index n = coordinates.layout.size;
    judged.integral = forms.size();
    forms.push_back(judged.flow_cost->parts.empty() ? Wide(Wide::Zero(n + 1, n + 1))
                                                    : judged.flow_cost->parts.front().matrix);
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

/// None when the dynamics are of another kind, or a claim is one that only careful runs understand.
std::unique_ptr<const SampledSetup> make_sampled_setup(const model::Instance& instance,
                                                       const model::Gains& gains,
                                                       const EventSetup& events) {
  // What only the careful run understands: an event, and a tolerance of a bound, which may be 0.
  const auto is_careful = [](const claims::Claim& claim) {
    return claim.over.has_value() || (claim.bound && claim.tolerance > 0);
  };
  if (events.texts.campaign.accuracy || std::ranges::any_of(events.claims, is_careful))
    return nullptr;
  auto setup = std::make_unique<SampledSetup>();
  setup->system = bounded::make_sampled_system(events.system);
  if (!setup->system) return nullptr;
  const bounded::SampledSystem& system = *setup->system;
  const std::vector<expr::Program> functions = functions_of(events.claims);
  if (!std::ranges::all_of(functions, [&](const expr::Program& one) {
        return bounded::has_error_bound(one, system.layout);
      }))
    return nullptr;
  if (system.flow) setup->steps.emplace(*system.flow, system.longest, system.flow_place);
  setup->coordinates = bounded::make_coordinates(
      system, hybrid::exact_values(instance, system.constants(), gains), functions);
  if (!setup->steps) add_integrals(events.claims, setup->coordinates);
  std::vector<Wide> forms;
  add_judged_claims(events.claims, *setup, forms);
  if (!setup->steps && !add_clocked_flows(*setup, events.scenario)) return nullptr;
  std::optional<bounded::ExactSteps> exact;
  if (setup->steps) exact = bounded::exact_steps(setup->coordinates, *setup->steps, forms);
  setup->narrow = std::make_unique<bounded::BoundedSystem<double>>(setup->coordinates, exact);
  // Bounds do not show that a saturation leaves a state as it is; other runs do.
  if (std::ranges::find(setup->narrow->linear_jump, false) != setup->narrow->linear_jump.end())
    return nullptr;
  if (exact)
    setup->wide = std::make_unique<bounded::BoundedSystem<DoubleDouble>>(setup->coordinates, exact);
  return setup;
}

}  // namespace

std::unique_ptr<const Setup> make_setup(const model::Instance& instance, const model::Gains& gains,
                                        const std::vector<hybrid::GivenRun>* given) {
  auto setup = std::make_unique<Setup>();
  setup->events = make_event_setup(bind::run_texts(instance, gains), given);
  setup->sampled = make_sampled_setup(instance, gains, *setup->events);
  if (!setup->sampled)
    if (auto texts = with_error_states(setup->events->texts, functions_of(setup->events->claims)))
      setup->errors = make_event_setup(std::move(*texts), given);
  return setup;
}

}  // namespace gainsmith::verify
