// The coordinates in which a run is judged: those of the claims, not those of the plant.
//
// A claim of z - zh that is computed from z and zh is lost in their rounding when they are large.
// So what a claim is about becomes a coordinate of its own:
//
//   d = a - b       for states a, b whose difference is part of a claim; d takes the place of b
//   w = expm(K) x   for x' = M x and K = s N, s a scalar with s' = r, when r N + M = 0:
//                   then w' = 0, and a claim of w does not see the rounding of expm
//
// and the maps of the others are rewritten with b = a - d. Coefficients are formed as polynomials
// (polynomial.h), so that equal terms cancel exactly. They are evaluated in 100 digits from the
// decimals, and what is left below kCoefficientNoise is 0. Coordinates that no claim depends on are
// dropped: a diverging plant has no part in the judgement of its observer.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "bounded/sampled_system.h"
#include "bounded/wide_function.h"

namespace gainsmith::bounded {

/// A coordinate; its slot is that of the same number in the layout.
struct Coordinate {
  expr::Program start;                ///< from the states of the system
  std::optional<expr::Program> flow;  ///< its derivative; none: 0
  std::optional<expr::Program> jump;  ///< its value after a jump; none: unchanged
  bool clock = false;                 ///< constant derivative, and jumps depend on clocks alone

  /// Whether the derivative depends on nothing that moves. There must be one.
  bool rate_is_constant(const hybrid::StateLayout& layout) const;
};

struct Coordinates {
  hybrid::StateLayout layout;
  std::vector<Coordinate> list;
  numbers::ValuesOf<Decimal100> constants;
  bool affine = true;  ///< whether the flow is, with constant coefficients
  /// The affine flow, x' = linear x + constant; what is 0 is exactly 0.
  numbers::MatrixOf<Decimal100> linear;
  numbers::MatrixOf<Decimal100> constant;
  /// The functions in these coordinates.
  std::vector<expr::Program> functions;

  /// Whether the elements of a coordinate stay as they are along flows.
  bool is_still(std::size_t coordinate) const;
};

/// Appends the integral over time of a 1 x 1 function of the coordinates, 0 at the start and kept
/// by jumps; the offset of its element. The flow must not be affine.
Eigen::Index add_integral(Coordinates& coordinates, const std::string& name,
                          const expr::Program& function);

/// Drops the coordinates on which no function depends, neither itself nor through flows and jumps.
void keep_needed(Coordinates& coordinates);

/// Marks the coordinates whose derivative is constant and whose jumps depend on such ones alone.
void mark_clocks(Coordinates& coordinates);

/// Coordinates for functions of the states, the timer and constants.
Coordinates make_coordinates(const SampledSystem& system, numbers::ValuesOf<Decimal100> constants,
                             const std::vector<expr::Program>& functions);

}  // namespace gainsmith::bounded
