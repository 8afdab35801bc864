// How long the next step of a method of order 8 may be.
#pragma once

#include <algorithm>
#include <cmath>

namespace gainsmith::ode {

/// 0.9 e^(-1/8) for the power of 2 above e, within [0.2, 4]: the same on every machine. `error`: of
/// the step before, as a part of what is allowed.
inline double step_factor(double error) {
  if (!(error > 0)) return 4;
  int exponent = 0;
  std::frexp(error, &exponent);
  constexpr double eighths[] = {1,
                                0.917004043204671232,
                                0.840896415253714543,
                                0.771105412703970411,
                                0.707106781186547524,
                                0.648419777325504832,
                                0.594603557501360533,
                                0.545253866332628830};
  const int part = ((exponent % 8) + 8) % 8;
  const double factor = 0.9 * std::ldexp(eighths[part], -(exponent - part) / 8);
  return std::clamp(factor, 0.2, 4.0);
}

}  // namespace gainsmith::ode
