// Responses in time, of a system at rest.
#pragma once

#include <optional>
#include <vector>

#include "response/state_space.h"

namespace gainsmith::response {

enum class Stimulus { step, impulse };

/// Of one input: the outputs at the times, p x (number of times).
struct TimeResponse {
  std::vector<double> t;
  Matrix y;
};

/// How long its modes take: some 7 time constants of the slowest one that dies out, until the
/// fastest one that grows is a hundred times its start.
double duration_of(const StateSpace& system);

/// y for u_j = 1 from t = 0 on, or for a Dirac impulse of it, whose direct part D is not drawn; of
/// a sampled system for the sequences 1, 1, 1, ... and 1/T, 0, 0, .... Times are equally spaced,
/// `points` > 1 of them, or the multiples of its step up to 100 000, and exact at these:
///   [x; u](t + h) = exp(h [A, b; 0, 0]) [x; u](t),   b column j of B.
TimeResponse time_response(const StateSpace& system, Stimulus stimulus, Eigen::Index input,
                           double until, int points = 1001);

/// What one reads from a step of a stable system. Shares are of the final value; where ends_at_0()
/// they say nothing, and what is left is the largest value.
struct StepFacts {
  double final_value = 0;
  double largest = 0;     ///< the value that is farthest from 0
  double largest_at = 0;  ///< when
  double overshoot = 0;   ///< by which share the final value is passed
  double undershoot = 0;  ///< which share it goes the other way before
  double rise = 0;        ///< from 10 to 90 %, both at their first time
  double settling = 0;    ///< from when on it is kept to 2 %

  /// Whether the final value is below 1e-9 of the largest one.
  bool ends_at_0() const;
};

/// Of one input and one output of a stable system, whatever the picture shows: the step is followed
/// in steps of 1/50 of the fastest mode that has not died out yet, to 1e-7 of the slowest one.
/// Nothing where that takes more than two million steps, of modes with less damping than some 5e-4.
std::optional<StepFacts> step_facts(const StateSpace& system, Eigen::Index input,
                                    Eigen::Index output);

}  // namespace gainsmith::response
