// Plant and observer as one hybrid system with a timer, compiled from a method's text.
//
//   flow, while the timer tau runs down to 0:   x' = M x + b,  tau' = -1
//   jump, when tau = 0:                          x+ = g(x),     tau+ in [low, high]
//
// x stacks the states of the plant and then of the observer. Whether the flow is affine is read
// from its text; it must be, and must not depend on the timer. Jump maps may be any expression.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "numbers/real.h"
#include "expr/scope.h"
#include "hybrid/affine.h"
#include "hybrid/layout.h"
#include "model/gains.h"
#include "model/instance.h"

namespace gainsmith::hybrid {

/// One state's value after a jump, as a function of the whole state before it.
struct JumpEntry {
  std::size_t slot = 0;
  expr::Program program;
};

struct System {
  Layout layout;
  /// Where a state starts when the campaign does not say; one a slot.
  std::vector<std::optional<expr::Expression>> starts;
  numbers::Values constants;  ///< data, parameters, gains and unknowns that have a value
  expr::Scope scope;       ///< of flow and jump maps, claims and signals
  AffineMap flow;
  Place flow_place;                      ///< where the fastest part of the flow stands
  std::vector<JumpEntry> jump;           ///< states that change; the others keep their value
  std::optional<AffineMap> affine_jump;  ///< when every entry of `jump` is affine
  double low = 0;                        ///< of the timer's reset values
  double high = 0;
  double first_low = 0;  ///< of its first value
  double first_high = 0;
};

/// InputError, at its place, for a flow that is not affine or depends on the timer, a gain without
/// a value or with a wrong shape, a timer whose bounds are not 0 <= low <= high (high > 0) and 0 <=
/// first_low <= first_high, and a method without a timer.
System make_system(const model::Instance& instance, const model::Gains& gains);

}  // namespace gainsmith::hybrid
