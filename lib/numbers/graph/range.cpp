#include "numbers/graph/range.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace gainsmith::numbers {

namespace {

/// Roundings are below a unit in the last place, those of libm below `ulps`.
Range widened(double low, double high, double ulps = 1) {
  const double part = ulps * std::numeric_limits<double>::epsilon();
  constexpr double least = std::numeric_limits<double>::denorm_min();
  return {low - part * std::abs(low) - least, high + part * std::abs(high) + least};
}

/// One whole number: sums and products of such are exact.
bool is_whole(const Range& a) {
  constexpr double largest = 0x1p53;
  return a.low == a.high && std::rint(a.low) == a.low && std::abs(a.low) <= largest;
}

bool is_zero(const Range& a) { return a.low == 0 && a.high == 0; }

/// The hull of the four products of ends; a square is not below 0.
Range product(const Range& a, const Range& b, bool square) {
  if (is_zero(a) || is_zero(b)) return {0, 0};
  if (is_whole(a) && is_whole(b) && is_whole({a.low * b.low, a.low * b.low}))
    return {a.low * b.low, a.low * b.low};
  if (square) {
    const Range made = widened(a.least() * a.least(), a.largest() * a.largest());
    return {std::max(made.low, 0.0), made.high};
  }
  const double p = a.low * b.low, q = a.low * b.high, r = a.high * b.low, s = a.high * b.high;
  return widened(std::min(std::min(p, q), std::min(r, s)),
                 std::max(std::max(p, q), std::max(r, s)));
}

/// Without the least double of widened(): sums that are too small for a full precision are exact.
Range difference(const Range& a, const Range& b) {
  constexpr double part = std::numeric_limits<double>::epsilon();
  const double low = a.low - b.high, high = a.high - b.low;
  if (is_whole(a) && is_whole(b) && is_whole({low, high})) return {low, high};
  return {low - part * std::abs(low), high + part * std::abs(high)};
}

Range sum(const Range& a, const Range& b) { return difference(a, {-b.high, -b.low}); }

/// The least interval that holds both.
Range hull(const Range& a, const Range& b) {
  return {std::min(a.low, b.low), std::max(a.high, b.high)};
}

constexpr double kFunctionUlps = 4;  ///< of libm

/// Of a function that rises.
template <class Function>
Range rising(const Range& a, const Function& function) {
  return widened(function(a.low), function(a.high), kFunctionUlps);
}

/// sin(x + phase), phase 0 or pi/2: from the ends, and 1 or -1 where a top or bottom lies inside.
Range sine(const Range& a, double phase) {
  constexpr double turn = 2 * std::numbers::pi;
  constexpr double far = 1e6;  // beyond, where its extrema are is rounded too much
  if (!(a.high - a.low < turn && a.largest() < far)) return {-1, 1};
  const auto at = [&](double x) { return phase == 0 ? std::sin(x) : std::cos(x); };
  const double first = at(a.low), last = at(a.high);
  Range made = widened(std::min(first, last), std::max(first, last), kFunctionUlps);
  // Whether a place x = top + k turn lies in the range, or next to it.
  const auto meets = [&](double top) {
    constexpr double beside = 1e-9;
    const double k = std::ceil((a.low - beside - top) / turn);
    return top + k * turn <= a.high + beside;
  };
  if (meets(std::numbers::pi / 2 - phase)) made.high = 1;
  if (meets(-std::numbers::pi / 2 - phase)) made.low = -1;
  return made;
}

/// a^b of one exponent b, where a > 0, or b is whole and >= 0; even powers by the size of a. False
/// otherwise.
bool power(const Range& a, const Range& b, Range& out) {
  if (b.low != b.high) return false;
  const double exponent = b.low;
  const bool whole = exponent == std::floor(exponent) && std::abs(exponent) < 64;
  if (!(a.low > 0) && !(whole && exponent >= 0)) return false;
  const bool even = whole && std::fmod(exponent, 2) == 0;
  const double low = std::pow(even ? a.least() : a.low, exponent);
  const double high = std::pow(even ? a.largest() : a.high, exponent);
  out = widened(std::min(low, high), std::max(low, high), kFunctionUlps);
  return true;
}

}  // namespace

bool enclose(ScalarOp op, const Range& a, const Range& b, const Range& c, bool square, Range& out) {
  switch (op) {
    case ScalarOp::add:
      out = sum(a, b);
      break;
    case ScalarOp::subtract:
      out = difference(a, b);
      break;
    case ScalarOp::multiply:
      out = product(a, b, square);
      break;
    case ScalarOp::multiply_add:
      out = sum(product(a, b, square), c);
      break;
    case ScalarOp::divide:
      if (!(b.least() > 0)) return false;
      // 1/b falls on each side of 0.
      out = product(a, widened(1 / b.high, 1 / b.low), false);
      break;
    case ScalarOp::negate:
      out = {-a.high, -a.low};
      break;
    case ScalarOp::minimum:
      out = {std::min(a.low, b.low), std::min(a.high, b.high)};
      break;
    case ScalarOp::maximum:
      out = {std::max(a.low, b.low), std::max(a.high, b.high)};
      break;
    case ScalarOp::where_positive:
      // Both branches where the sign of the condition is not known.
      out = a.low > 0 ? b : a.high <= 0 ? c : hull(b, c);
      break;
    case ScalarOp::where_nonnegative:
      out = a.low >= 0 ? b : a.high < 0 ? c : hull(b, c);
      break;
    case ScalarOp::abs:
      out = {a.least(), a.largest()};
      break;
    case ScalarOp::sign:
      out = {a.low > 0    ? 1.0
             : a.low == 0 ? 0.0
                          : -1.0,
             a.high < 0    ? -1.0
             : a.high == 0 ? 0.0
                           : 1.0};
      break;
    case ScalarOp::floor:
      out = {std::floor(a.low), std::floor(a.high)};
      break;
    case ScalarOp::exp:
      out = rising(a, [](double x) { return std::exp(x); });
      break;
    case ScalarOp::log:
      if (!(a.low > 0)) return false;
      out = rising(a, [](double x) { return std::log(x); });
      break;
    case ScalarOp::sqrt:
      // Sums of squares may be below 0 by what their underflow is widened by.
      if (!(a.low > -std::numeric_limits<double>::min())) return false;
      out = rising(a, [](double x) { return std::sqrt(std::max(x, 0.0)); });
      out.low = std::max(out.low, 0.0);
      break;
    case ScalarOp::sin:
      out = sine(a, 0);
      break;
    case ScalarOp::cos:
      out = sine(a, std::numbers::pi / 2);
      break;
    case ScalarOp::tanh:
      out = rising(a, [](double x) { return std::tanh(x); });
      break;
    case ScalarOp::real_power:
      if (!power(a, b, out)) return false;
      break;
    default:
      return false;
  }
  // Ends that are infinite or NaN are no bounds.
  return out.low - out.low == 0 && out.high - out.high == 0;
}

}  // namespace gainsmith::numbers
