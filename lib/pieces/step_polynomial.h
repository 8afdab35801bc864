// A value over a step of a run as a polynomial of the share s of the step, 0 to 1, with an estimate
// of its error. In Bernstein form
//   p(s) = sum_k B_k C(n, k) s^k (1 - s)^(n-k)
// it lies between its least and its largest coefficient, and its sign changes at most as often as
// theirs (Farouki and Rajan, Computer Aided Geometric Design 4, 1987). De Casteljau's algorithm
// gives the coefficients of both halves of a part, whose bounds are sharper: so maxima, rises and
// first changes of sign are found by halving, without samples. The bounds hold of the polynomial
// but for rounding; the error against the value itself is an estimate.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>

namespace gainsmith::pieces {

/// A polynomial of a degree up to 5 over one step, and how far the value may be from it.
class StepPolynomial {
 public:
  static constexpr std::size_t kMostTerms = 6;
  using Coefficients = std::array<double, kMostTerms>;

  /// The coefficients B_0 ... B_n on [0, 1], 1 to kMostTerms of them, and its error.
  StepPolynomial(std::span<const double> b, double error);

  /// With the opposite sign.
  StepPolynomial negated() const;
  std::span<const double> coefficients() const { return {b_.data(), count_}; }
  /// p(share).
  double operator()(double share) const;
  /// The largest coefficient: p is not above it.
  double largest() const;
  struct Highest {
    double attained = 0;  ///< at some point; hardly less than the largest value
    double most = 0;      ///< not below it, and hardly more
  };
  Highest highest() const;
  /// How far it is from the value.
  double error() const { return error_; }
  /// By how much it rises in all, wherever it does: a bound from above, close to it.
  double rise() const;
  /// Whether dp/ds <= -margin everywhere; false where 64 parts do not show it.
  bool falls(double margin) const;
  /// The share at which it first comes to the other side of 0, by more than `zero` beyond; none
  /// where it does not. `side`: 1 or -1, on which it starts; 0: that of the first coefficient
  /// beyond `zero`.
  std::optional<double> first_change(int side, double zero) const;

 private:
  Coefficients b_{};
  std::size_t count_ = 1;
  double error_ = 0;
};

}  // namespace gainsmith::pieces
