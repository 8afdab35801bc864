// Everything that the runs of a campaign share, made once and then only read.
//
// Of linear sampled dynamics the coordinates are those of linear/coordinates.h. Of other dynamics
// errors of observers become states where they move by themselves (error_states.h).
#pragma once

#include <memory>
#include <vector>

#include "claims/run_setup.h"
#include "linear/coordinates.h"
#include "linear/sampled_system.h"

namespace gainsmith::verify {

/// Dynamics with one clock and an affine flow, in the coordinates of the claims that are stated.
struct LinearSetup {
  std::unique_ptr<const linear::SampledSystem> system;
  linear::Coordinates coordinates;
};

struct Setup {
  std::unique_ptr<const claims::RunSetup> events;  ///< the careful run
  std::unique_ptr<const claims::RunSetup>
      errors;  ///< the same with errors as states; none: there are none
  std::unique_ptr<const LinearSetup> linear;  ///< none: the dynamics are of another kind
  std::vector<std::string> unread;            ///< bind::unread_names()

  const std::vector<claims::Claim>& claims() const { return events->claims; }
  /// By which the careful run judges.
  const claims::RunSetup& judged() const { return errors ? *errors : *events; }
  double horizon() const { return events->scenario.horizon; }
};

/// At an address of its own: its parts point to each other. `given`: runs whose draws are given
/// (hybrid/given_run.h); they must outlive the setup.
std::unique_ptr<const Setup> make_setup(const model::Instance& instance, const model::Gains& gains,
                                        const std::vector<hybrid::GivenRun>* given = nullptr);

}  // namespace gainsmith::verify
