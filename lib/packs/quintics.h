// The quintic through a value and its rate at the start, the middle and the end of a step, in
// Bernstein form.
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

/// That of a value in one lane, of a machine that has run StepPolynomials::code. Its error is an estimate
/// with a margin: twice what it is off at the quarters of the step; at least what the quartic without
/// the rate at the end would miss, times 0.15.
pieces::StepPolynomial quintic(lanes::LaneMachine& made, std::size_t value, std::size_t lane);

/// Where the quartic through values at 0, 1/4, 1/2, 3/4 and 1 first changes its sign between two of
/// them.
std::optional<double> first_root(const std::array<double, 5>& values);

}  // namespace gainsmith::packs
