#include "verify/setup.h"

#include <utility>

namespace gainsmith::verify {

Setup make_setup(const model::Instance& instance, const model::Gains& gains) {
  const model::Design& design = *instance.design;
  hybrid::System system = hybrid::make_system(instance, gains);
  hybrid::Scenario scenario = hybrid::make_scenario(design, system);
  hybrid::FlowSteps steps = hybrid::make_steps(system);
  std::vector<LinkedClaim> claims = link_claims(design, system);
  return {std::move(system), std::move(scenario), std::move(steps), std::move(claims)};
}

std::vector<ClaimCheck> make_checks(const Setup& setup) {
  std::vector<ClaimCheck> checks;
  for (const LinkedClaim& claim : setup.claims)
    if (claim.stated()) checks.emplace_back(claim, setup.system, setup.steps);
  return checks;
}

}  // namespace gainsmith::verify
