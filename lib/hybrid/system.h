// Plant and observer as one hybrid system with a timer, for the gains of one file.
//
//   flow, while the timer tau runs down to 0:   x' = f(x, tau),  tau' = -1
//   jump, when tau = 0:                          x+ = g(x),       tau+ in [low, high]
//
// x stacks the states of the plant and then of the observer. Whether the flow is M x + b with
// constant M and b is read from its program: such a flow is exact (steps.h), others are integrated
// (integrated_run.h). Jump maps may be any expression.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "hybrid/affine.h"
#include "hybrid/state_layout.h"
#include "model/stated.h"

namespace gainsmith::hybrid {

/// One state's derivative, or its value after a jump, as a function of the whole state.
struct MapEntry {
  std::size_t slot = 0;
  expr::Program program;
};

struct System {
  StateLayout layout;
  numbers::Values constants;  ///< data, parameters, gains and unknowns that have a value
  model::Bodies bodies;       ///< of unknown functions and of gains that are functions
  std::vector<MapEntry> flow_entries;
  std::optional<AffineMap> flow;         ///< when it is affine and does not depend on the timer
  Place flow_place;                      ///< where the fastest part of the flow stands
  std::vector<MapEntry> jump;            ///< states that change; the others keep their value
  std::optional<AffineMap> affine_jump;  ///< when every entry of `jump` is affine
  double low = 0;                        ///< of the timer's reset values
  double high = 0;
  double first_low = 0;  ///< of its first value
  double first_high = 0;

  /// The program of a formula, without calls.
  expr::Program link(const model::Formula& formula) const;
  /// The inputs of a linked program that neither move nor have a value, in the program's order.
  std::vector<std::string> missing(const expr::Program& program) const;
  /// The value of a formula of constants. InputError, at its place, when it uses anything else.
  numbers::Matrix value(const model::Formula& formula) const;
  /// The same, of a 1 x 1 formula.
  double scalar(const model::Formula& formula) const { return value(formula)(0, 0); }
};

/// InputError, at its place, for a gain without a value or with a wrong shape, a timer whose bounds
/// are not 0 <= low <= high (high > 0) and 0 <= first_low <= first_high, and a method without a
/// timer.
System make_system(const model::Instance& instance, const model::Gains& gains);

}  // namespace gainsmith::hybrid
