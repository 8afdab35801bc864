// The quintic through a value and its rate at the start, the middle and the end of a step, in
// Bernstein form: it lies between its least and its largest coefficient.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "lanes/machine.h"

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
/// Result k: the coefficients B_1 ... B_4 of value k and its error (StepPolynomial).
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

class StepPolynomial {
 public:
  /// Of a machine that has run StepPolynomials::code.
  StepPolynomial(lanes::LaneMachine& made, std::size_t value, std::size_t lane);

  /// With the opposite sign.
  StepPolynomial negated() const;
  /// B_0 ... B_5 on [0, 1], the share of the step.
  const std::array<double, 6>& coefficients() const { return b_; }
  double operator()(double share) const;
  double largest() const;
  struct Highest {
    double attained = 0;  ///< at some point; hardly less than the largest value
    double most = 0;      ///< not below it, and hardly more
  };
  Highest highest() const;
  /// An estimate of how far it is from what it interpolates, with a margin: twice what it is off
  /// at the quarters of the step; at least what the quartic without the rate at the end would
  /// miss, times 0.15.
  double error() const { return error_; }
  /// By how much it rises in all, wherever it does; hardly less than that is said.
  double rise() const;
  /// Whether it falls everywhere, by `margin` over the whole step at the least.
  bool falls(double margin) const;
  /// The share at which it comes to 0 from the side that it is on at the start (`side`), by
  /// Halley's method between bounds. It must end on the other side.
  double root(int side) const;

 private:
  std::array<double, 6> b_{};
  double error_ = 0;
};

/// Where the quartic through values at 0, 1/4, 1/2, 3/4 and 1 first changes its sign between two of
/// them.
std::optional<double> first_root(const std::array<double, 5>& values);

}  // namespace gainsmith::packs
