// Internal to numbers: what simulators ask at each step of small matrices of doubles, by Eigen,
// without allocation. Each function is false, for the answer to be found otherwise, where M is
// larger than 8 x 8.
#pragma once

#include <cmath>

#include "numbers/matrix.h"

namespace gainsmith::numbers {

/// Powers of two d with d_i^2 M_ii from 1 to 4, of a symmetric M with a diagonal > 0; ones
/// otherwise. In them neither the pivots nor the condition of a positive definite matrix depend on
/// its units.
template <class Units>
Units symmetric_units(const Matrix& M) {
  Units d = Units::Ones(M.rows());
  const auto diagonal = M.diagonal().array();
  if (!(diagonal > 0).all() || !diagonal.allFinite() || M != M.transpose()) return d;
  for (Eigen::Index i = 0; i < d.size(); ++i)
    d[i] = std::ldexp(1.0, -static_cast<int>(std::floor(std::ilogb(M(i, i)) / 2.0)));
  return d;
}

/// Writes the inverse of M, column by column, as inverse() of dense.h finds it, up to rounding.
/// False also where the reciprocal condition of M is below 2^-25.
bool small_inverse(const Matrix& M, double* out);

/// Writes the min(rows, cols) singular values of M, largest first. False also where an element is
/// not finite.
bool small_singular_values(const Matrix& M, double* out);

/// Writes the rates u_k' dM v_k of the singular values as M moves by dM, in their order. That of a
/// value of 0 is 0. Equal values have no rate of their own: these are of some u_k, v_k. False as
/// above.
bool small_singular_slopes(const Matrix& M, const Matrix& dM, double* out);

}  // namespace gainsmith::numbers
