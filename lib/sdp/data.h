// The working problem: what the presolve hands to the iteration.
#pragma once

#include <vector>

#include "sdp/layout.h"
#include "sdp/linalg.h"

namespace gainsmith::sdp {

/// One stored entry of a symmetric F_i, row <= column.
struct Term {
  int row = 0;
  int column = 0;
  double value = 0;
};

/// The rows of all F_i within one block, grouped by i: list k holds terms start[k] .. start[k+1]-1
/// of F_{constraint[k]}; constraint 0 is F_0. For the linear part, row == column is the entry's
/// index.
struct BlockData {
  std::vector<int> constraint;
  std::vector<std::size_t> start{0};
  std::vector<Term> terms;

  int lists() const { return static_cast<int>(constraint.size()); }
};

/// minimise c'x s.t. sum x_i F_i - F_0 in the cone `layout`, after presolve and scaling. The
/// scaling factors are powers of two, so these doubles are exact and serve every precision.
struct Data {
  Layout layout;
  std::vector<double> c;
  std::vector<BlockData> dense;  ///< one a dense block
  BlockData linear;

  int m() const { return static_cast<int>(c.size()); }
};

/// S = sum_i x_i F_i - tau F_0, both triangles.
template <typename T>
void adjoint(const Data& data, const Vector<T>& x, const T& tau, Blocks<T>& s);

/// r_i = F_i . S for i = 1..m (r has m entries); returns F_0 . S. S is taken as symmetric.
template <typename T>
T apply(const Data& data, const Blocks<T>& s, Vector<T>& r);

}  // namespace gainsmith::sdp
