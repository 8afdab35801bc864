// What Eigen has to know of the scalars beyond double. In base, because two rooms' answers that
// differ would break what both instantiate; without including Eigen, which the room that includes
// this brings along: <Eigen/Core> comes first.
#pragma once

#include "base/scalars.h"

#ifndef EIGEN_CORE_H
#error "include <Eigen/Core> before base/eigen_scalars.h"
#endif

template <>
struct Eigen::NumTraits<gainsmith::DoubleDouble>
    : Eigen::GenericNumTraits<gainsmith::DoubleDouble> {
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 0,
    ReadCost = 2,
    AddCost = 20,
    MulCost = 10
  };
  static gainsmith::DoubleDouble dummy_precision() { return {1e-28}; }
};

namespace gainsmith {

/// Of numbers that own memory: to read one costs so much.
template <class Number, int cost>
struct WideTraits : Eigen::GenericNumTraits<Number> {
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = cost,
    AddCost = 10 * cost,
    MulCost = 20 * cost
  };
};

}  // namespace gainsmith

template <>
struct Eigen::NumTraits<gainsmith::Decimal100> : gainsmith::WideTraits<gainsmith::Decimal100, 10> {
};
