// Exact multipliers (faces.h) near those that a solver found.
//
// A solver's Y_k is V S V' and rounding, the range V of a face. Elimination with the largest
// diagonal elements first tells the rows P of a basis and C, V = [I; C] in them; where the elements
// of C are fractions of few digits, they are these. With G_i = V' B_i V the multiplier V S V' is
// exact when r_i = sum_k <G_ki, S_k> = 0, and
//   S + dS,  dS = -sum_j (H^-1 r)_j S G_j S,   H_ij = sum_k <G_ki, S_k G_kj S_k>
// is so in fractions. It is one when it is still positive definite, which is tested exactly: what
// was guessed meanwhile does not matter. v is like a strict block of its own where it is not 0.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "base/eigen_scalars.h"
#include "numbers/matrix.h"
#include "verdict/faces.h"

namespace gainsmith::verdict {

/// What a solver found for the blocks that are left, each with the rows that stay, in units in
/// which they are balanced.
struct FoundMultipliers {
  /// One for each block of `faces`, in its order.
  std::vector<numbers::MatrixOf<DoubleDouble>> Y;
  std::vector<std::vector<int>> rows;  ///< log2 of the unit of each row: Y is S^-1 times the
                                       ///< multiplier in the units of the data times S^-1
  double v = 0;                        ///< multiplier of the constant parts
};

/// Of the blocks with Y_k != 0.
struct ExactMultipliers : FaceMultipliers {
  enum class Say { nothing, excludes, restricts };
  Say say = Say::nothing;
};

/// Several ranks and several lengths of fractions are tried; the first that is exact is returned.
/// Where none is, `say` is nothing and the rest empty. `excludes`: v > 0 or a strict block counts;
/// `restricts`: v = 0, only blocks with >= count.
ExactMultipliers exact_multipliers(const Faces& faces, const FoundMultipliers& found);

/// The ranges of projectors onto kernels of the blocks with >=, in fractions within `relative`;
/// none where an element is near no short one, or all are 0.
std::optional<std::vector<FaceOfBlock>> fractions_near(const Faces& faces,
                                                       const FoundMultipliers& projectors,
                                                       double relative);

/// Exact multipliers near those that were found that have these ranges: every solution is on the
/// face. Without S where there are none.
FaceMultipliers exact_on(const Faces& faces, std::vector<FaceOfBlock> on,
                         const FoundMultipliers& found);

}  // namespace gainsmith::verdict
