// Where along a flow the values of claims are looked at.
//
//   - at the ends of 32 equal parts of it
//   - at the times from which on claims are made
//   - where the text of a value branches (hybrid/breaks.h): at kinks, on both sides of jumps - a
//     little aside, and of a value with a bound next to them too -, half-way between these, and
//     where it nearly branches
//   - where a value with a bound is largest: of the ends and the middles of the steps and of the
//     parts between breaks, the best one with its neighbours by golden section
//
// A smooth value that comes to its peak twice within half a step may hide one of them.
#pragma once

#include <cstddef>
#include <vector>

#include "verify/run_values.h"

namespace gainsmith::verify {

/// What the claims of a method ask for besides the equal parts.
struct FlowLooks {
  /// The peak of sign * function, from a time on.
  struct Peak {
    std::size_t function = 0;
    double sign = 1;
    double after = 0;
  };
  std::vector<double> times;
  std::vector<std::size_t> along;  ///< functions whose branches matter
  std::vector<Peak> peaks;
};

/// A place of a flow [from, to]: t = from + share (to - from), to rounding.
struct FlowLook {
  double share = 0;  ///< in (0, 1]
  double t = 0;
  int function = -1;  ///< the one for whose sake alone it is there; -1: for all
};

/// In order of time; the last is the end of the flow.
std::vector<FlowLook> looks_along(const hybrid::FlowPiece& flow, const FlowLooks& looks,
                                  std::vector<RunValue>& functions);

/// All variables at a place of a flow.
Eigen::VectorXd state_at(const hybrid::FlowPiece& flow, double share);

}  // namespace gainsmith::verify
