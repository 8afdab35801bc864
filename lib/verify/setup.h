// Everything that the runs of a campaign share, made once and then only read.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "hybrid/bounded_run.h"
#include "hybrid/integrated_run.h"
#include "hybrid/simulate.h"
#include "hybrid/system.h"
#include "verify/claim_check.h"
#include "verify/claims.h"
#include "verify/event_setup.h"

namespace gainsmith::verify {

/// Of a flow that is not affine with constant coefficients, `narrow` is without steps and `wide`
/// is not there: its runs are integrated.
struct Setup {
  hybrid::System system;
  hybrid::Scenario scenario;
  std::optional<hybrid::FlowSteps> steps;  ///< of an affine flow
  std::vector<LinkedClaim> claims;
  hybrid::Coordinates coordinates;  ///< those of the claims that are stated
  std::vector<JudgedClaim> judged;  ///< the claims that are stated, in order
  std::unique_ptr<hybrid::BoundedSystem<double>> narrow;
  std::unique_ptr<hybrid::BoundedSystem<DoubleDouble>> wide;
  std::unique_ptr<hybrid::SharedFlows> shared;  ///< of integrated flows
  /// Of dynamics with events: then `system`, `coordinates` and `narrow` are not used.
  std::unique_ptr<const EventSetup> events;
};

/// At an address of its own: its parts point to each other.
std::unique_ptr<const Setup> make_setup(const model::Instance& instance, const model::Gains& gains);

/// A check for each claim that is stated, in order. The setup must outlive them.
template <class Scalar>
std::vector<ClaimCheck<Scalar>> make_checks(const Setup& setup,
                                            const hybrid::BoundedSystem<Scalar>& system) {
  std::vector<ClaimCheck<Scalar>> checks;
  for (const JudgedClaim& claim : setup.judged) checks.emplace_back(claim, system);
  return checks;
}

}  // namespace gainsmith::verify
