// Everything that the runs of a campaign share, made once and then only read.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "bounded/bounded_run.h"
#include "bounded/clocked_run.h"
#include "bounded/sampled_system.h"
#include "claims/claim_check.h"
#include "claims/claims.h"
#include "verify/careful_runs.h"

namespace gainsmith::verify {

/// How the runs of sampled dynamics (bounded/sampled_system.h) are made and judged: with bounds
/// where the flow is affine, otherwise by flows that all runs share.
struct SampledSetup {
  std::unique_ptr<const bounded::SampledSystem> system;
  std::optional<bounded::FlowSteps> steps;  ///< of an affine flow
  bounded::Coordinates coordinates;         ///< those of the claims that are stated
  std::vector<claims::JudgedClaim> judged;  ///< the claims that are stated, in order
  std::unique_ptr<bounded::BoundedSystem<double>> narrow;
  std::unique_ptr<bounded::BoundedSystem<DoubleDouble>> wide;  ///< of an affine flow
  std::unique_ptr<bounded::ClockedFlows> flows;                ///< of any other
};

struct Setup {
  std::unique_ptr<const EventSetup> events;     ///< the careful run
  std::unique_ptr<const EventSetup> errors;     ///< with errors as states; none: there are none
  std::unique_ptr<const SampledSetup> sampled;  ///< none: runs are made in packs, or careful

  const std::vector<claims::Claim>& claims() const { return events->claims; }
  /// By which the careful run judges.
  const EventSetup& judged() const { return errors ? *errors : *events; }
  double horizon() const { return events->scenario.horizon; }
  /// Whether the errors of runs are estimates.
  bool integrated() const { return !sampled || !sampled->steps; }
};

/// At an address of its own: its parts point to each other. `given`: runs whose draws are given
/// (hybrid/given_run.h); they must outlive the setup.
std::unique_ptr<const Setup> make_setup(const model::Instance& instance, const model::Gains& gains,
                                        const std::vector<hybrid::GivenRun>* given = nullptr);

/// A check for each claim that is stated, in order. The claims and the system must outlive them.
template <class Scalar>
std::vector<claims::ClaimCheck<Scalar>> make_checks(const std::vector<claims::JudgedClaim>& claims,
                                                    const bounded::BoundedSystem<Scalar>& system) {
  std::vector<claims::ClaimCheck<Scalar>> checks;
  for (const claims::JudgedClaim& claim : claims) checks.emplace_back(claim, system);
  return checks;
}

}  // namespace gainsmith::verify
