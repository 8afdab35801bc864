// Everything that the runs of a campaign share, made once and then only read.
#pragma once

#include <vector>

#include "hybrid/simulate.h"
#include "hybrid/system.h"
#include "verify/claim_check.h"
#include "verify/claims.h"

namespace gainsmith::verify {

struct Setup {
  hybrid::System system;
  hybrid::Scenario scenario;
  hybrid::FlowSteps steps;
  std::vector<LinkedClaim> claims;
};

Setup make_setup(const model::Instance& instance, const model::Gains& gains);

/// A check for each claim that is stated, in order: what campaigns and replays look at. The setup
/// must outlive them.
std::vector<ClaimCheck> make_checks(const Setup& setup);

}  // namespace gainsmith::verify
