// Sampled dynamics that are linear, in 100 digits, in the coordinates of their claims.
//
//   flow    x' = A x                    jump    x+ = B D x,  D (r x n), B (n x r)
//   start   x = S xi,  xi what is drawn
//
// D may depend on clocks, and so on the length of the flow before (jump.h).
//
// A constant is one more coordinate that stays 1, the last of x and of xi; then the last row of D
// is (0, ..., 0, 1). Behind a jump x = B z with r numbers z. Claims are quadratic forms with
// factors of the timer:
//
//   nonincreasing   falls along all flows, shown once: runs compare it at jumps alone, and not
//                   there
//                   either where it falls at all jumps
//   cost            of forms that are nowhere negative: it is largest at the end
//   shrinks, below  of a form, or of the root of one (norm(e)): squares are compared. What a value
//                   may grow by along a flow is bounded for all states (proof.h)
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "claims/claims.h"
#include "hybrid/scenario.h"
#include "linear/coordinates.h"
#include "linear/flow.h"
#include "linear/jump.h"

namespace gainsmith::linear {

/// A number that is drawn: an element of the start of a state.
struct DrawnElement {
  std::size_t variable = 0;  ///< of the dynamics
  Eigen::Index element = 0;  ///< of the state, column by column
};

/// One term g(tau) x'Q x of a claim. Q is n x n, symmetric.
struct LinearForm {
  std::optional<expr::Program> factor;  ///< of the timer; none: 1
  Wide Q;
};

/// A claim over quadratic forms; which members count depends on its kind.
struct LinearClaim {
  model::ClaimKind kind = model::ClaimKind::nonincreasing;
  bool squared = false;  ///< the value is the root of the forms
  std::vector<LinearForm> value;
  std::optional<Wide> flow_cost, jump_cost;  ///< of `cost`
  double factor = 0;                         ///< of `shrinks`, > 0
  double bound = 0;                          ///< of `below`
  double growth = 1;                         ///< of `below`: a value grows by it at most in a flow
  double tolerance = 0;                      ///< of `nonincreasing`: a part of the least value
  bool falls = false;                        ///< of `nonincreasing`: shown for all runs (proof.h)
};

/// Whether runs compare a claim at jumps.
inline bool is_compared(const LinearClaim& claim) {
  return claim.kind == model::ClaimKind::nonincreasing && !claim.falls;
}

inline bool is_bounded(const LinearClaim& claim) { return claim.kind == model::ClaimKind::below; }

/// n coordinates x with the constant, r numbers z with it; A n x n, B n x r, D r x n, S n x m.
/// Pointers refer to what make_linear_model was given.
struct LinearModel {
  const SampledSystem* sampled = nullptr;
  const hybrid::Scenario* scenario = nullptr;
  const Coordinates* coordinates = nullptr;
  bool constant = false;  ///< whether the last coordinate is 1
  Wide A, B, S;
  std::shared_ptr<const LinearJump> jump;
  std::vector<Eigen::Index> jump_rows;  ///< of x, those of D
  std::vector<DrawnElement> drawn;
  std::vector<LinearClaim> claims;
  double low = 0, high = 0;              ///< lengths between jumps
  double first_low = 0, first_high = 0;  ///< up to the first jump

  /// D at the end of a flow; `first`: the one from the start. None where B D is not the jump: its
  /// range is found at some lengths, and may be larger at others.
  std::optional<Wide> D(const Decimal100& length, bool first) const;
  double longest() const { return first_high > high ? first_high : high; }
};

/// None for dynamics, starts and claims of another kind. The functions of the coordinates are the
/// programs of the claims that are stated (claims::programs_of). Everything given must outlive it.
std::optional<LinearModel> make_linear_model(const SampledSystem& sampled,
                                             const hybrid::Scenario& scenario,
                                             const Coordinates& coordinates,
                                             const std::vector<claims::Claim>& claims);

}  // namespace gainsmith::linear
