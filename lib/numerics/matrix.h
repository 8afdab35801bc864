// Dense matrices of a scalar type.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace gainsmith::numerics {

template <class Scalar>
using MatrixOf = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

using Matrix = MatrixOf<double>;
using Vector = Eigen::VectorXd;

/// Of a small matrix Eigen's allFinite takes several times as long.
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
