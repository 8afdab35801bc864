#include "verify/setup.h"

#include <utility>

namespace gainsmith::verify {

Setup make_setup(const model::Instance& instance, const model::Gains& gains) {
  hybrid::System system = hybrid::make_system(instance, gains);
  hybrid::Scenario scenario = hybrid::make_scenario(instance.problem->campaign, system);
  hybrid::Steps steps = hybrid::make_steps(system);
  std::vector<CompiledClaim> claims = compile_claims(instance, system);
  return {std::move(system), std::move(scenario), std::move(steps), std::move(claims)};
}

std::vector<Check> make_checks(const Setup& setup) {
  std::vector<Check> checks;
  for (const CompiledClaim& claim : setup.claims)
    if (claim.stated()) checks.emplace_back(claim, setup.system, setup.steps);
  return checks;
}

}  // namespace gainsmith::verify
