// The number types that the solver is built for.
#pragma once

#include <boost/multiprecision/mpfr.hpp>
#include <string>
#include <type_traits>

#include "sdp/double_double.h"
#include "sdp/linalg.h"

namespace gainsmith::sdp {

/// 100 decimal digits (MPFR, kept on the stack), for small problems that 31 do not settle.
using Decimal100 = boost::multiprecision::number<
    boost::multiprecision::mpfr_float_backend<100, boost::multiprecision::allocate_stack>,
    boost::multiprecision::et_off>;

/// Decimal digits of each arithmetic.
constexpr int kDoubleDigits = 15, kQuadDigits = 31, kWideDigits = 100;

/// "double", "31 digits", "100 digits".
template <typename T>
std::string name_of() {
  if constexpr (std::is_same_v<T, double>)
    return "double";
  else
    return std::to_string(std::is_same_v<T, DoubleDouble> ? kQuadDigits : kWideDigits) + " digits";
}

template <>
inline Decimal100 as<Decimal100, DoubleDouble>(const DoubleDouble& value) {
  return Decimal100(value.hi()) + Decimal100(value.lo());
}
template <>
inline DoubleDouble as<DoubleDouble, Decimal100>(const Decimal100& value) {
  const double high = static_cast<double>(value);
  return {high, static_cast<double>(Decimal100(value - high))};
}

}  // namespace gainsmith::sdp

template <>
struct Eigen::NumTraits<gainsmith::sdp::Decimal100>
    : Eigen::GenericNumTraits<gainsmith::sdp::Decimal100> {
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

// Expands DO(T) for each of them; used at the end of a source for its explicit instantiations.
#define GAINSMITH_FOR_EACH_SCALAR(DO) \
  DO(double)                          \
  DO(DoubleDouble)                    \
  DO(Decimal100)
