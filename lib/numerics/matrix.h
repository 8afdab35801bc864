// Dense matrices of a scalar type.
//
// The folder holds numerical methods over matrices and functions, which know nothing of texts and
// number types:
//   balance.h            units of powers of two (Osborne 1960; Curtis & Reid 1972)
//   projection.h         nearest points of polytopes, ellipsoids and affine sets, rounded once
//                        (Goldfarb & Idnani 1983);  convex_projection.h  of convex sets
//   extrapolation.h      y' = f(q, y) over any scalar (Gragg 1965; Bulirsch & Stoer 1966)
//   box_search.h         large values of a function over a box;  golden_section.h  on an interval
//   lattice.h            whole solutions of linear equations (Lenstra, Lenstra & Lovasz 1982)
//   matrix_products.h    lower bounds of a joint spectral radius (Gripenberg 1996)
//   output_gain.h        static output feedback by BFGS (Burke, Henrion, Lewis & Overton 2006)
//   working.h            the arithmetic in which a result is computed before it is rounded
// Searches promise nothing but that the value that they return is taken at their point.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace gainsmith::numerics {

template <class Scalar>
using MatrixOf = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

using Matrix = MatrixOf<double>;
using Vector = Eigen::VectorXd;

/// Whether all elements are finite. Of a small matrix Eigen's allFinite takes several times as
/// long.
template <class Scalar>
bool is_finite(const MatrixOf<Scalar>& A) {
  using std::isfinite;
  return std::all_of(A.data(), A.data() + A.size(), [](const Scalar& x) { return isfinite(x); });
}

/// A B without the blocking of large matrices: for small ones, and for scalars beyond double, for
/// which that takes long to compile.
template <class Scalar>
MatrixOf<Scalar> times(const MatrixOf<Scalar>& A, const MatrixOf<Scalar>& B) {
  return A.lazyProduct(B);
}

}  // namespace gainsmith::numerics
