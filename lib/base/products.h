// Products that are added to a sum, rounded as the two operations are. In 100 digits they are made
// in a place that stays: operators copy each product twice.
#pragma once

#include "base/scalars.h"

namespace gainsmith {

/// sum += a b
template <typename T>
void add_times(T& sum, const T& a, const T& b, T& room) {
  if constexpr (std::is_same_v<T, Decimal100>) {
    mpfr_mul(room.backend().data(), a.backend().data(), b.backend().data(), MPFR_RNDN);
    mpfr_add(sum.backend().data(), sum.backend().data(), room.backend().data(), MPFR_RNDN);
  } else {
    sum += a * b;
  }
}

/// sum -= a b
template <typename T>
void subtract_times(T& sum, const T& a, const T& b, T& room) {
  if constexpr (std::is_same_v<T, Decimal100>) {
    mpfr_mul(room.backend().data(), a.backend().data(), b.backend().data(), MPFR_RNDN);
    mpfr_sub(sum.backend().data(), sum.backend().data(), room.backend().data(), MPFR_RNDN);
  } else {
    sum -= a * b;
  }
}

}  // namespace gainsmith
