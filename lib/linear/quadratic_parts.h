// Functions that are quadratic in the coordinates, with factors that depend on the timer and on
// clocks:
//
//   v(x, tau) = sum_m g_m(tau) [x; 1]' Q_m [x; 1]
//
// found from the text (polynomial.h); the Q_m are in 100 digits.
#pragma once

#include <optional>
#include <vector>

#include "linear/coordinates.h"

namespace gainsmith::linear {

/// One term.
struct QuadraticPart {
  std::optional<expr::Program> factor;   ///< of the timer and clocks; none: 1
  numbers::MatrixOf<Decimal100> matrix;  ///< symmetric, of [x; 1]
};

/// None where the function is of another kind. No parts: it is 0.
std::optional<std::vector<QuadraticPart>> quadratic_parts(const expr::Program& program,
                                                          const Coordinates& coordinates);

}  // namespace gainsmith::linear
