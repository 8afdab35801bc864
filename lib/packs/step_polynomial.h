// The quintic through a value and its rate at the start, the middle and the end of a step, in
// Bernstein form: it lies between its least and its largest coefficient.
#pragma once

#include <array>

namespace gainsmith::packs {

/// A value and its rate, at one of the three points.
struct Sample {
  double value = 0;
  double rate = 0;
};

class StepPolynomial {
 public:
  StepPolynomial(Sample start, Sample middle, Sample end, double length);

  /// B_0 ... B_5 on [0, 1], the share of the step.
  const std::array<double, 6>& coefficients() const { return b_; }
  double operator()(double share) const;
  double largest() const;
  /// The largest of its values, or hardly more.
  double highest() const;
  /// An estimate of how far it is from what it interpolates, with a margin: what the quartic
  /// without the rate at the end would miss, times 0.15.
  double error() const { return error_; }
  /// By how much it rises in all, wherever it does; hardly less than that is said.
  double rise() const;
  /// The share at which it comes to 0 from the side that it is on at the start (`side`), by
  /// bisection. It must end on the other side.
  double root(int side) const;

 private:
  std::array<double, 6> b_{};
  double error_ = 0;
};

}  // namespace gainsmith::packs
