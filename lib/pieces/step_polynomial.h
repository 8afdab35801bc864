// A value over a step of a run as a polynomial of the share of the step, with an estimate of its error.
// In Bernstein form it lies between its least and its largest coefficient, and its sign changes at most
// as often as theirs (Farouki and Rajan, Computer Aided Geometric Design 4, 1987).
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>

namespace gainsmith::pieces {

class StepPolynomial {
 public:
  static constexpr std::size_t kMostTerms = 6;
  using Coefficients = std::array<double, kMostTerms>;

  /// The coefficients B_0 ... B_n on [0, 1], and its error.
  StepPolynomial(std::span<const double> b, double error);

  /// With the opposite sign.
  StepPolynomial negated() const;
  std::span<const double> coefficients() const { return {b_.data(), count_}; }
  double operator()(double share) const;
  double largest() const;
  struct Highest {
    double attained = 0;  ///< at some point; hardly less than the largest value
    double most = 0;      ///< not below it, and hardly more
  };
  Highest highest() const;
  /// How far it is from the value.
  double error() const { return error_; }
  /// By how much it rises in all, wherever it does; hardly less than that is said.
  double rise() const;
  /// Whether it falls everywhere, by `margin` over the whole step at the least.
  bool falls(double margin) const;
  /// The share at which it first comes to the other side of 0, by more than `zero` beyond; none where it
  /// does not. `side`: 1 or -1, on which it starts; 0: the first on which it is by more than `zero`.
  std::optional<double> first_change(int side, double zero) const;

 private:
  Coefficients b_{};
  std::size_t count_ = 1;
  double error_ = 0;
};

}  // namespace gainsmith::pieces
