// Products of some matrices in any order that grow fastest: lower bounds of their joint spectral
// radius, by branch and bound (Gripenberg, "Computing the joint spectral radius", Linear Algebra
// and its Applications 234, 1996).
//
//   x(k+1) = A_i(k) x(k),  i(k) chosen freely:   x grows when rho(A_i(k) ... A_i(1)) > 1 for some
//   sequence, which is then repeated
//
// Of the products of k factors those are kept whose every beginning has ||A_i(j) ... A_i(1)||^(1/j)
// above the best rho^(1/k) so far, and above 1: of a sequence that grows faster some rotation has
// beginnings that all are. The norm is |T x|, with T'T = P the fixed point of P -> sum A_i' P A_i
// up to a factor.
#pragma once

#include <cstddef>
#include <vector>

#include "numerics/matrix.h"

namespace gainsmith::numerics {

struct MatrixProduct {
  std::vector<std::size_t> factors;  ///< in the order of time: the first is applied first
  double growth = 0;                 ///< rho(product)^(1/number of factors)
};

struct ProductOptions {
  std::size_t longest = 12;    ///< number of factors
  std::size_t most = 200'000;  ///< products that are formed; then the largest ones go on
};

/// The largest of the moduli of the eigenvalues; 0 of an empty matrix.
double spectral_radius(const Matrix& A);

/// The product that grows fastest, of those that were kept. Square matrices of one size, at least
/// one.
MatrixProduct fastest_product(const std::vector<Matrix>& factors,
                              const ProductOptions& options = {});

}  // namespace gainsmith::numerics
