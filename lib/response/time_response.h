// Responses in time, of a system at rest.
#pragma once

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

/// y for u_j = 1 from t = 0 on, or for a Dirac impulse of it, whose direct part D is not drawn; of a sampled
/// system for the sequences 1, 1, 1, ... and 1/T, 0, 0, .... Times are equally spaced, `points` of them, or the multiples of
/// its step; exact at these by exponentials.
TimeResponse time_response(const StateSpace& system, Stimulus stimulus, Eigen::Index input,
                           double until, int points = 1001);

/// What one reads from a step of a stable system, 1 input and 1 output.
struct StepFacts {
  double final_value = 0;
  double overshoot = 0;  ///< by how much of the final value it is passed
  double rise = 0;       ///< from 10 to 90 % of it
  double settling = 0;   ///< from when on it is kept to 2 %
};
StepFacts step_facts(const StateSpace& system, const TimeResponse& step);

}  // namespace gainsmith::response
