// The Cholesky factorisation over any scalar. (Of doubles alone: dense.h, which is faster.)
#pragma once

#include <cmath>

#include "base/stop.h"
#include "numbers/matrix.h"

namespace gainsmith::numbers {

/// L with A = L L', n x n, over the lower triangle of A, of which alone it reads; what is above
/// stays. False as soon as a pivot is not > 0.
///   L_jj = sqrt(A_jj - sum_{k<j} L_jk^2),   L_ij = (A_ij - sum_{k<j} L_ik L_jk) / L_jj
template <class S>
bool factor_in_place(MatrixOf<S>& A) {
  using std::sqrt;
  const Eigen::Index n = A.rows();
  for (Eigen::Index j = 0; j < n; ++j) {
    check_stop();
    S pivot = A(j, j);
    for (Eigen::Index k = 0; k < j; ++k) pivot -= A(j, k) * A(j, k);
    if (!(pivot > S(0))) return false;
    A(j, j) = sqrt(pivot);
    for (Eigen::Index i = j + 1; i < n; ++i) {
      S element = A(i, j);
      for (Eigen::Index k = 0; k < j; ++k) element -= A(i, k) * A(j, k);
      A(i, j) = element / A(j, j);
    }
  }
  return true;
}

}  // namespace gainsmith::numbers
