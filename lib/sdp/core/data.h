// The working problem: what the presolve hands to the iteration.
#pragma once

#include <cstddef>
#include <type_traits>
#include <vector>

#include "base/scalars.h"
#include "sdp/core/layout.h"
#include "sdp/problem.h"
#include "sdp/schur/linalg.h"

namespace gainsmith::sdp {

/// One stored entry of a symmetric F_i, row <= column.
struct Term {
  int row = 0;
  int column = 0;
  double value = 0;
  double rest = 0;  ///< Entry::rest
};

/// value + rest in T; the value alone in double.
template <typename T>
T coefficient(double value, double rest) {
  if constexpr (std::is_same_v<T, double>) {
    return value;
  } else {
    return as<T>(DoubleDouble(value, rest));
  }
}
template <typename T>
T coefficient(const Term& term) {
  return coefficient<T>(term.value, term.rest);
}
/// With its finer part where T has room for it.
template <typename T>
T coefficient(const Problem& problem, const Entry& e) {
  if constexpr (std::is_same_v<T, Decimal100>)
    if (e.finer > 0)
      return with_finer({e.value, e.rest}, problem.finer[static_cast<std::size_t>(e.finer) - 1]);
  return coefficient<T>(e.value, e.rest);
}

/// The rows of all F_i within one block, grouped by i: list k holds terms start[k] .. start[k+1]-1
/// of F_{constraint[k]}; constraint 0 is F_0. For the linear part, row == column is the entry's
/// index.
struct BlockData {
  std::vector<int> constraint;
  std::vector<std::size_t> start{0};
  std::vector<Term> terms;
  std::vector<Decimal100> wide;  ///< the same in 100 digits; empty where no entry has a finer part

  /// Where any F_i (F_0 included) or the diagonal has an entry, both triangles: rows of column j
  /// are pattern_row[pattern_start[j]] .. [pattern_start[j+1] - 1]. X and dX live there. Kept for
  /// large blocks of which it is a small part; else empty.
  std::vector<int> pattern_start, pattern_row;

  int lists() const { return static_cast<int>(constraint.size()); }
  bool sparse() const { return !pattern_start.empty(); }
};

template <typename T>
T coefficient(const BlockData& block, std::size_t t) {
  if constexpr (std::is_same_v<T, Decimal100>)
    if (!block.wide.empty()) return block.wide[t];
  return coefficient<T>(block.terms[t]);
}

/// minimise c'x s.t. sum x_i F_i - F_0 in the cone `layout`, after presolve and scaling. The
/// scaling factors are powers of two, so these numbers are those of the problem as given and serve
/// every precision.
struct Data {
  Layout layout;
  std::vector<double> c, c_rest;
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
