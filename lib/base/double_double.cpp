// Functions of numbers of 31 digits that have no short formula in two doubles: by MPFR, in 50
// digits.
#include "base/double_double.h"

#include <boost/multiprecision/mpfr.hpp>

namespace gainsmith {
namespace {

/// More digits than an argument has whose halves touch: what rounding took from it would show near
/// a zero of sin or log.
using Guarded = boost::multiprecision::number<
    boost::multiprecision::mpfr_float_backend<50, boost::multiprecision::allocate_stack>,
    boost::multiprecision::et_off>;

Guarded wide(const DoubleDouble& a) {
  return isfinite(a) ? Guarded(Guarded(a.hi()) + Guarded(a.lo())) : Guarded(a.hi());
}

/// hi = a rounded to double, lo = (a - hi) rounded to double.
DoubleDouble narrow(const Guarded& a) {
  const auto high = static_cast<double>(a);
  if (!std::isfinite(high)) return {high};
  return {high, static_cast<double>(Guarded(a - high))};
}

}  // namespace

DoubleDouble exp(const DoubleDouble& a) { return narrow(exp(wide(a))); }
DoubleDouble log(const DoubleDouble& a) { return narrow(log(wide(a))); }
DoubleDouble sin(const DoubleDouble& a) { return narrow(sin(wide(a))); }
DoubleDouble cos(const DoubleDouble& a) { return narrow(cos(wide(a))); }
DoubleDouble tanh(const DoubleDouble& a) { return narrow(tanh(wide(a))); }
DoubleDouble pow(const DoubleDouble& a, const DoubleDouble& b) {
  return narrow(pow(wide(a), wide(b)));
}
DoubleDouble atan2(const DoubleDouble& y, const DoubleDouble& x) {
  return narrow(atan2(wide(y), wide(x)));
}

}  // namespace gainsmith
