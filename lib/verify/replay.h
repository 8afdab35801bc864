// One run of a campaign again, with everything that a person wants to see of it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hybrid/arc.h"
#include "model/gains.h"
#include "model/instance.h"
#include "verify/claim_check.h"

namespace gainsmith::verify {

/// A claim in this run.
struct ReplayedClaim {
  std::string name;
  Finding finding;
};

/// The run as a table with a row for each sample of the arc. Columns: t, j, the timer, the states,
/// the method's signals, then for each claim that is stated its value and, for a cost, the cost so
/// far (`name_cost`). A 1 x 1 value has its name; the elements of a column z are z1, z2, ...; those
/// of any other matrix M are M1_1, M2_1, ....
struct Replay {
  hybrid::Arc arc;
  std::vector<std::string> columns;
  numbers::Matrix table;
  std::vector<ReplayedClaim> claims;  ///< exactly what the campaign found in this run
};

/// Signals that use a symbol without a value are left out.
Replay replay(const model::Instance& instance, const model::Gains& gains, std::uint64_t seed,
              std::uint64_t run);

}  // namespace gainsmith::verify
