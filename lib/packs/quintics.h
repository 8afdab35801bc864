// The quintic through a value and its rate at the start, the middle and the end of a step, in
// Bernstein form. With the share s of the step in [0, 1], its length h, values v and rates r:
//
//   b_0 = v_0,   b_5 = v_1,   b_1 = b_0 + h r_0/5,   b_4 = b_5 - h r_1/5
//   (b_2 + b_3)/2 = (32 v_m - b_0 - b_5 - 5 (b_1 + b_4))/20
//   (b_3 - b_2)/2 = (16 h r_m/5 + b_0 - b_5 + 3 (b_1 - b_4))/4                             (1)
//
// from p(1/2) = v_m and p'(1/2) = h r_m. Its error is of order h^6. Maxima, rises and roots come
// from the coefficients (pieces/step_polynomial.h), so that no dense output of the steps is needed.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "lanes/machine.h"
#include "pieces/step_polynomial.h"

namespace gainsmith::packs {

/// A value and its rate, at one of the three points.
struct Sample {
  double value = 0;
  double rate = 0;
};

/// A value over a step.
struct StepSamples {
  double length = 0;
  Sample start, middle, end;
};

/// What the quintic is at a quarter of a step of length 1, and at three quarters with start and end
/// exchanged and rates negated: its weights on values and rates at start, middle and end.
struct QuarterWeights {
  static constexpr double values[] = {45.0 / 128, 9.0 / 16, 11.0 / 128};
  static constexpr double rates[] = {9.0 / 256, -9.0 / 64, -3.0 / 256};
};

/// The quintics of `count` values over the steps of all lanes.
///
/// Inputs: the length of the step; of each value as InputOfValue says, `input_of`.
/// Result k: the coefficients B_1 ... B_4 of value k and its error (quintic).
struct StepPolynomials {
  enum InputOfValue : std::size_t {
    start,
    start_rate,
    middle,
    middle_rate,
    end,
    end_rate,
    quarter,
    three_quarters,
    inputs
  };
  static std::size_t input_of(std::size_t value, InputOfValue which) {
    return 1 + value * inputs + which;
  }
  static lanes::LaneCode code(std::size_t count);
};

/// That of a value in one lane, of a machine that has run StepPolynomials::code. Its error is an
/// estimate with a margin: twice what it is off at the quarters of the step; at least what the
/// quartic without the rate at the end would miss, times 0.15.
pieces::StepPolynomial quintic(lanes::LaneMachine& made, std::size_t value, std::size_t lane);

/// Where the quartic through values at 0, 1/4, 1/2, 3/4 and 1 first changes its sign between two of
/// them.
std::optional<double> first_root(const std::array<double, 5>& values);

}  // namespace gainsmith::packs
