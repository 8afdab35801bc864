// The sample points along a flow at which the values of claims are compared:
//
//   - the ends of 32 equal parts of it
//   - the times from which on claims are made
//   - where the text of a value branches (hybrid/breaks.h): kinks, both sides of jumps at a small
//     distance, the middles between these, and points at which it nearly branches; of a value with
//     a bound also points next to the jumps
//   - the peak of a value with a bound, by golden section from the series of its parts
//     (smooth_parts.h)
//   - the turning points of a value that must not increase and rises by more than its noise
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "claims/run_values.h"

namespace gainsmith::claims {

/// What the claims of a method ask for besides the equal parts.
struct SamplePoints {
  /// The peak of sign * function, from a time on.
  struct Peak {
    std::size_t function = 0;
    double sign = 1;
    double after = 0;
  };
  /// A function that must not increase, from a time on.
  struct Falling {
    std::size_t function = 0;
    double after = 0;
  };
  std::vector<double> times;
  std::vector<std::size_t> along;  ///< functions whose branches matter
  std::vector<Peak> peaks;
  std::vector<Falling> falling;
};

/// Which rises of values that must not increase get sample points.
struct RiseLimits {
  double noise = 0;       ///< of the size of a value, what a rise has to exceed
  double agreement = 0;   ///< to which the values are followed (smooth_parts.h)
  Eigen::VectorXd floor;  ///< the size of each function below which it is compared with nothing
};

/// A place of a flow [from, to]: t = from + share (to - from), to rounding.
struct SamplePoint {
  double share = 0;  ///< in (0, 1]
  double t = 0;
  int function = -1;  ///< the one for whose sake alone it is there; -1: for all
};

/// In order of time; the last is the end of the flow. A function that branches more often than can
/// be searched gets none from there on but the equal parts: RunValue::followed_until.
std::vector<SamplePoint> points_along(const hybrid::FlowPiece& flow, const SamplePoints& wanted,
                                      std::vector<RunValue>& functions, const RiseLimits& rises);

/// All variables at a place of a flow.
Eigen::VectorXd state_at(const hybrid::FlowPiece& flow, double share);

}  // namespace gainsmith::claims
