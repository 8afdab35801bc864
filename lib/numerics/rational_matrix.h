// Dense matrices of fractions.
#pragma once

#include "base/rational.h"
#include "numerics/matrix.h"

template <>
struct Eigen::NumTraits<gainsmith::Rational> : Eigen::GenericNumTraits<gainsmith::Rational> {
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = 10,
    AddCost = 100,
    MulCost = 200
  };
};

namespace gainsmith::numerics {

using RationalMatrix = MatrixOf<Rational>;

}  // namespace gainsmith::numerics
