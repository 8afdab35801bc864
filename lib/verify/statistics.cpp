#include "verify/statistics.h"

#include <cmath>
#include <initializer_list>

namespace gainsmith::verify {

namespace {

/// The continued fraction of I_x(a, b) by Lentz's method; converges fast for x < (a + 1)/(a + b +
/// 2).
double beta_fraction(double a, double b, double x) {
  constexpr double kTiny = 1e-300;
  constexpr int kMostTerms = 100000;
  const auto away_from_zero = [](double value) { return std::abs(value) < kTiny ? kTiny : value; };
  double c = 1;
  double d = 1 / away_from_zero(1 - (a + b) * x / (a + 1));
  double fraction = d;
  for (int m = 1; m <= kMostTerms; ++m) {
    const double even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
    const double odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
    double change = 1;
    for (const double term : {even, odd}) {
      d = 1 / away_from_zero(1 + term * d);
      c = away_from_zero(1 + term / c);
      change = c * d;
      fraction *= change;
    }
    if (std::abs(change - 1) < 1e-15) break;
  }
  return fraction;
}

}  // namespace

double incomplete_beta(double a, double b, double x) {
  if (x <= 0) return 0;
  if (x >= 1) return 1;
  const double front = std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) +
                                a * std::log(x) + b * std::log1p(-x));
  if (x < (a + 1) / (a + b + 2)) return front * beta_fraction(a, b, x) / a;
  return 1 - front * beta_fraction(b, a, 1 - x) / b;
}

double violation_probability_bound(std::uint64_t violations, std::uint64_t runs,
                                   double confidence) {
  if (violations >= runs) return 1;
  const auto n = static_cast<double>(runs);
  if (violations == 0) return -std::expm1(std::log1p(-confidence) / n);
  // P(at most k of n | p) = 1 - I_p(k + 1, n - k) falls as p grows.
  const auto k = static_cast<double>(violations);
  double low = k / n;
  double high = 1;
  for (int i = 0; i < 100; ++i) {
    const double middle = (low + high) / 2;
    (incomplete_beta(k + 1, n - k, middle) < confidence ? low : high) = middle;
  }
  return high;
}

}  // namespace gainsmith::verify
