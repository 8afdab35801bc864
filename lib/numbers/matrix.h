// Dense matrices of a scalar type.
#pragma once

#include <Eigen/Core>

namespace gainsmith::numbers {

template <class Scalar>
using MatrixOf = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

using Matrix = MatrixOf<double>;
using Vector = Eigen::VectorXd;

}  // namespace gainsmith::numbers
