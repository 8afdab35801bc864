// Dense matrices of a scalar type.
#pragma once

#include <Eigen/Core>

namespace gainsmith::numerics {

template <class Scalar>
using MatrixOf = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

using Matrix = MatrixOf<double>;
using Vector = Eigen::VectorXd;

/// A B without the blocking of large matrices: for small ones, and for scalars beyond double, for
/// which that takes long to compile.
template <class Scalar>
MatrixOf<Scalar> times(const MatrixOf<Scalar>& A, const MatrixOf<Scalar>& B) {
  return A.lazyProduct(B);
}

}  // namespace gainsmith::numerics
