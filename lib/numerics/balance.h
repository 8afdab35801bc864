// Units in which a matrix is small: A = D B D^-1 with D of powers of two.
#pragma once

#include <vector>

#include "numerics/matrix.h"

namespace gainsmith::numerics {

/// Exponents e with B = D^-1 A D, D = diag(2^e), from the sizes |A|. Inside a strongly connected
/// part of its graph the rows and columns of B weigh alike (Osborne 1960; Parlett & Reinsch 1969),
/// and what leads from one part to another is no larger than the parts themselves: units alone
/// decide on its size, and it costs no squarings in an exponential.
///
/// In other units that are powers of two B is the same bit for bit: A is first put into units that
/// do not depend on its own, which minimise sum (log2 |B_ij|)^2 over i != j, |A_ij| > 0, with the
/// first state of each connected part as it is. All zero where a size is not finite.
std::vector<int> balance(const Matrix& sizes);

/// D^-1 A D, with exponents from balance(); D A D^-1 with their negatives.
template <class S, class Scale>
MatrixOf<S> in_units(const MatrixOf<S>& A, const std::vector<int>& exponents, const Scale& scale) {
  MatrixOf<S> result(A.rows(), A.cols());
  for (Eigen::Index j = 0; j < A.cols(); ++j)
    for (Eigen::Index i = 0; i < A.rows(); ++i)
      result(i, j) = scale(
          A(i, j), exponents[static_cast<std::size_t>(j)] - exponents[static_cast<std::size_t>(i)]);
  return result;
}

}  // namespace gainsmith::numerics
