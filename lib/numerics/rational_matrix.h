// Dense matrices of fractions.
#pragma once

#include <Eigen/Core>

#include "base/eigen_scalars.h"
#include "base/rational.h"
#include "numerics/matrix.h"

template <>
struct Eigen::NumTraits<gainsmith::Rational> : gainsmith::WideTraits<gainsmith::Rational, 10> {};

namespace gainsmith::numerics {

using RationalMatrix = MatrixOf<Rational>;

}  // namespace gainsmith::numerics
