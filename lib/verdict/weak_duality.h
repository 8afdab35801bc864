// Lower bounds of an objective, shown by weak duality.
//
// Y_k with residuals r_i = c_i - sum_k <B_ki, Y_k>, i >= 1, and L_k with L_k L_k' near Y_k. With
// the g_i and H of exactness.h, of L_k L_k', and r' H^-1 r = theta^2,
//   dY_k = sum_j (H^-1 r)_j L_k L_k' B_kj L_k L_k'
// leaves no residual. Where Y_k >= theta L_k L_k', Y + dY >= 0, so that for all x with B_k(x) >= 0
//   c_0 + c'x >= c_0 - sum_k <B_k0, Y_k + dY_k> >= c_0 - sum_k <B_k0, Y_k> - theta |g_0|
// whatever the size of x. With any R near H^-1/2, theta <= |R'r| / sigma, sigma the smallest
// singular value of the matrix of the g_i times R; all rounded outward.
#pragma once

#include <optional>
#include <vector>

#include "lmi/formulation.h"
#include "numbers/types/ball.h"
#include "verdict/exact.h"
#include "verdict/faces.h"
#include "verdict/solved_multipliers.h"

namespace gainsmith::verdict {

/// c_0 ... c_m.
using Costs = std::vector<numbers::Ball<DoubleDouble>>;

/// Those of the objective of the inequalities, by the decimals of the file.
/// Size m + 1, in the units of the data. There must be an objective.
Costs exact_objective(const lmi::Inequalities& of);

/// The same in the coordinates y of a face, x = x_0 + N y.
Costs on_face(const Faces& faces, const Costs& costs);

/// A bound with multipliers that show it: their residuals are rounding, and those that are singular
/// have been lifted. One a block, of its rows; no rows: 0.
struct LowerBound {
  double value = 0;
  std::vector<numbers::Matrix> Y;
};

/// The greatest bound that is shown with multipliers near Y; none where none is. c_i that are
/// beyond the costs are 0.
std::optional<LowerBound> lower_bound(const std::vector<ExactBlock<DoubleDouble>>& blocks,
                                      const Multipliers& Y, Costs costs);

/// Of the objective of the inequalities, within the gain bounds, by the dual solution of its
/// program. What represents no point of its domain is taken as it was solved. The multipliers are
/// of the program, in balanced units.
std::optional<LowerBound> lower_bound(const lmi::Inequalities& of, const lmi::Lmi& lmi,
                                      const lmi::GainBounds& bounds,
                                      const lmi::Formulation& formulation,
                                      const sdp::Solution& solution);

}  // namespace gainsmith::verdict
