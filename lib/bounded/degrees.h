// Degrees of the series of this room: what is left of a series is a part of the bound of its error.
#pragma once

namespace gainsmith::bounded::degree {

/// Largest 1-norm of a matrix whose exponential is a series.
constexpr double norm = 0.25;

constexpr int wide_exponential = 80;   ///< in 100 digits, of a norm up to 1: below 1e-118
constexpr int wide_rest = 40;          ///< of what is left of an interval, in 100 digits
constexpr int short_exponential = 20;  ///< in long double: below 1e-31
constexpr int rest = 12;               ///< of what is left of an interval, in double
constexpr int shared_flow = 16;        ///< of Chebyshev polynomials over a piece of a flow

}  // namespace gainsmith::bounded::degree
