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

/// Exponents e with D^-1 A D and C D near 1, D = diag(2^e): they minimise
///   sum (log2 |D^-1 A D|_ij)^2 + sum (log2 |C D|_kj)^2   over i != j and elements that are not 0,
/// from the sizes |A|, n x n, and |C|, p x n, of outputs whose units stay as they are (Curtis &
/// Reid 1972). The first state of a connected part without outputs stays as it is. In other units
/// of the states that are powers of two D^-1 A D and C D are the same bit for bit. All zero where a
/// size is not finite.
std::vector<int> units(const Matrix& A, const Matrix& C);

/// Of the rows and columns of M, n x n: 2^-rows M 2^columns is near 1 in the same sense.
struct Equilibrium {
  std::vector<int> rows, columns;
};
Equilibrium equilibrium(const Matrix& sizes);

/// 2^-rows A 2^columns; scale(x, k) is x 2^k.
template <class S, class Scale>
MatrixOf<S> in_units(const MatrixOf<S>& A, const std::vector<int>& rows,
                     const std::vector<int>& columns, const Scale& scale) {
  MatrixOf<S> result(A.rows(), A.cols());
  for (Eigen::Index j = 0; j < A.cols(); ++j)
    for (Eigen::Index i = 0; i < A.rows(); ++i)
      result(i, j) =
          scale(A(i, j), columns[static_cast<std::size_t>(j)] - rows[static_cast<std::size_t>(i)]);
  return result;
}

/// D^-1 A D, with exponents from balance(); D A D^-1 with their negatives.
template <class S, class Scale>
MatrixOf<S> in_units(const MatrixOf<S>& A, const std::vector<int>& exponents, const Scale& scale) {
  return in_units(A, exponents, exponents, scale);
}

}  // namespace gainsmith::numerics
