// The coordinates in which a run is judged: those of the claims, not those of the plant.
//
// A claim of z - zh that is computed from z and zh is lost in their rounding when they are large.
// So what a claim is about becomes a coordinate of its own:
//
//   d = a - b       for states a, b whose difference is part of a claim; d takes the place of b
//   w = expm(K) x   for x' = M x and K = s N, s a scalar with s' = r, when r N + M = 0:
//                   then w' = 0, and the rounding of expm does not affect a claim of w
//
// and the maps of the others are rewritten with b = a - d. Coefficients are formed as polynomials
// (polynomial.h), so that equal terms cancel exactly. They are evaluated in 100 digits from the
// decimals, and what is left below kCoefficientNoise is 0. Coordinates that no claim depends on are
// dropped: a diverging plant has no part in the judgement of its observer.
//
// This room runs sampled linear dynamics many times faster than steps do. A run is a product of
// polynomials of the lengths between jumps, with a bound of every error:
//
//   sampled_system    which dynamics are of this kind: one timer, an affine flow
//   coordinates, differences, dependence    this change of coordinates
//   polynomial        the exact algebra of texts that it needs
//   quadratic_parts   claims as quadratic forms
//   model, jump, flow   x' = A x, x+ = B D x, and their matrices in 100 digits
//   proof             which forms decrease for all states
//   length_table      functions of a length as polynomials
//   system, graph, error_graph, block   the code over lanes and its error bounds
//   wide_function     functions and affine maps in 100 digits
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "linear/sampled_system.h"
#include "linear/wide_function.h"

namespace gainsmith::linear {

/// A coordinate; its slot is that of the same number in the layout.
struct Coordinate {
  expr::Program start;                ///< from the states of the system
  std::optional<expr::Program> flow;  ///< its derivative; none: 0
  std::optional<expr::Program> jump;  ///< its value after a jump; none: unchanged
  bool clock = false;                 ///< constant derivative, and jumps depend on clocks alone
};

/// The flow is affine with constant matrices, n x n and n x 1 with n = layout.size. `list` and
/// layout.slots have the same order.
struct Coordinates {
  hybrid::StateLayout layout;
  std::vector<Coordinate> list;
  numbers::ValuesOf<Decimal100> constants;
  /// The flow, x' = linear x + constant; what is 0 is exactly 0.
  numbers::MatrixOf<Decimal100> linear;
  numbers::MatrixOf<Decimal100> constant;
  /// The functions in these coordinates.
  std::vector<expr::Program> functions;
};

/// Drops the coordinates on which no function depends, neither itself nor through flows and jumps.
void keep_needed(Coordinates& coordinates);

/// Marks the coordinates whose derivative is constant and whose jumps depend on such ones alone.
void mark_clocks(Coordinates& coordinates);

/// Coordinates for functions of the states, the timer and constants.
Coordinates make_coordinates(const SampledSystem& system, numbers::ValuesOf<Decimal100> constants,
                             const std::vector<expr::Program>& functions);

/// The jump as an affine map; none when a coefficient depends on clocks or an entry is not affine.
std::optional<WideMap> affine_jump(const Coordinates& coordinates);

}  // namespace gainsmith::linear
