// One claim against one run.
//
// With v(k) the claim's value at sample k, v(0) at the start:
//
//   nonincreasing   v(k) <= min over i < k of v(i)   at every sample, over jumps too
//   cost            c(k) <= v(0)                     at every sample; c(k) is the cost so far,
//                   int flow_cost dt + sum of jump_cost at the samples before jumps
//   shrinks         v(end) <= factor v(0)            held at once when v(0) = 0
//
// The comparison is that of real numbers; what is forgiven is rounding only, 1e-9 of |v(0)| (of
// |factor v(0)| for shrinks) plus the rounding floor
//
//   sum over the elements i of x of  |v(x + d e_i) - v(x)|,  d = 1e-12 max |x| up to that sample,
//
// taken at that sample or, for a cost, whose bound is v(0), at the start. That is how far the value
// moves when every element of the state is wrong in its twelfth digit: an error z - zh of two large
// numbers cannot be known better. It is never more than |v(0)| (unless that is 0): a horizon so
// long that rounding outgrows the start counts as violated, not as held.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "hybrid/arc.h"
#include "hybrid/steps.h"
#include "hybrid/system.h"
#include "verify/along.h"
#include "verify/claims.h"

namespace gainsmith::verify {

/// How near a run came to violating a claim.
struct Finding {
  bool violated = false;
  /// (value - bound) / |scale|, the scale being v(0) or, for `shrinks`, factor v(0). While
  /// `nonincreasing` holds, value and bound are v(end) and v(0): what is left at the end. Infinite
  /// when a value is no number or the scale of a violation is 0; -1 when the scale is 0 and the
  /// claim holds.
  double score = -1;
  double value = 0;  ///< at the worst sample
  double bound = 0;  ///< what it must not exceed there
  double t = 0;      ///< where that is, in hybrid time
  std::int64_t j = 0;
};

/// Checks one claim, run after run; one for each thread. All arguments must outlive it.
class ClaimCheck {
 public:
  /// The claim must be stated.
  ClaimCheck(const LinkedClaim& claim, const hybrid::System& system,
             const hybrid::FlowSteps& steps);

  const LinkedClaim& claim() const { return *claim_; }

  Finding operator()(const hybrid::Arc& arc);

  /// The claim's value at every sample.
  Eigen::VectorXd values(const hybrid::Arc& arc);
  /// cost: c at every sample.
  Eigen::VectorXd running_cost(const hybrid::Arc& arc);

 private:
  Finding nonincreasing(const hybrid::Arc& arc);
  Finding cost(const hybrid::Arc& arc);
  Finding shrinks(const hybrid::Arc& arc);
  /// The value at one sample, alone.
  double value_at(const hybrid::Arc& arc, std::size_t sample);
  /// The rounding floor of the value at `sample`, with the largest |x| up to the sample `last`.
  double rounding_floor(const hybrid::Arc& arc, std::size_t sample, std::size_t last);
  /// The same at each of the samples; `largest` is max |x| for each.
  Eigen::VectorXd rounding_floors(const hybrid::Arc& arc, const std::vector<std::size_t>& samples,
                                  const Eigen::VectorXd& largest);

  const LinkedClaim* claim_;
  const hybrid::FlowSteps* steps_;
  AlongFunction value_;
  std::optional<AlongFunction> flow_cost_;
  std::optional<AlongFunction> jump_cost_;
  std::optional<AlongFunction> factor_;
};

}  // namespace gainsmith::verify
