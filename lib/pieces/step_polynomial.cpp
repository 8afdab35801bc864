#include "pieces/step_polynomial.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace gainsmith::pieces {

namespace {

using Coefficients = StepPolynomial::Coefficients;

/// A search for a zero ends so near to it.
constexpr double kZeroWithin = 2e-15;
/// After a step of Halley's method that is such a part of the zero, the digits triple.
constexpr double kLastStep = 1e-5;

constexpr std::integral_constant<std::size_t, StepPolynomial::kMostTerms> kFull;

/// The `count` coefficients of its two halves.
void split(const Coefficients& b, std::size_t count, Coefficients& left, Coefficients& right) {
  left = right = b;
  for (std::size_t level = 1; level < count; ++level) {
    for (std::size_t k = count - 1; k >= level; --k) left[k] = (left[k] + left[k - 1]) / 2;
    for (std::size_t k = 0; k < count - level; ++k) right[k] = (right[k] + right[k + 1]) / 2;
  }
}

/// Widens what the polynomial attains, at the ends of halves of halves, and what it is not above,
/// their coefficients. Parts that cannot attain more are left out.
void widen(const Coefficients& b, std::size_t count, int depth, StepPolynomial::Highest& highest) {
  highest.attained = std::max({highest.attained, b[0], b[count - 1]});
  const double largest = *std::max_element(b.begin(), b.begin() + static_cast<long>(count));
  if (largest <= highest.attained) return;
  if (depth == 0) {
    highest.most = std::max(highest.most, largest);
    return;
  }
  Coefficients left, right;
  split(b, count, left, right);
  widen(left, count, depth - 1, highest);
  widen(right, count, depth - 1, highest);
}

/// The sum of all rises, of the coefficients of parts that are so short.
double rise_of(const Coefficients& b, std::size_t count, int depth) {
  double rise = 0;
  for (std::size_t k = 1; k < count; ++k) rise += std::max(b[k] - b[k - 1], 0.0);
  if (depth == 0 || rise == 0) return rise;
  Coefficients left, right;
  split(b, count, left, right);
  return rise_of(left, count, depth - 1) + rise_of(right, count, depth - 1);
}

/// Whether the derivative is below -margin on parts that are so short.
bool falls_within(const Coefficients& b, std::size_t count, double margin, int depth) {
  const double part = margin / static_cast<double>(count - 1);
  const auto rises = [&](std::size_t k) { return b[k] - b[k - 1] > -part; };
  bool everywhere = true;
  for (std::size_t k = 1; k < count; ++k) everywhere = everywhere && !rises(k);
  if (everywhere) return true;
  if (depth == 0 || rises(1) || rises(count - 1)) return false;
  Coefficients left, right;
  split(b, count, left, right);
  return falls_within(left, count, margin / 2, depth - 1) &&
         falls_within(right, count, margin / 2, depth - 1);
}

/// By de Casteljau's algorithm.
double at(Coefficients b, std::size_t count, double share) {
  for (std::size_t level = count - 1; level > 0; --level)
    for (std::size_t k = 0; k < level; ++k) b[k] += share * (b[k + 1] - b[k]);
  return b[0];
}

/// The only zero, from `side` to the other one: Halley's steps between bounds, from where the
/// coefficients change their sign. In powers of the share, with c_k = C(n, k) (k-th difference).
/// `count`: a number, or one that the compiler knows, which takes half of the time.
double only_zero(const Coefficients& b, auto count, int side) {
  std::size_t beyond = 1;
  while (beyond + 1 < count && side * b[beyond] > 0) ++beyond;
  const double part = b[beyond - 1] / (b[beyond - 1] - b[beyond]);
  Coefficients c = b;
  for (std::size_t k = 1; k < count; ++k) {
    for (std::size_t i = count - 1; i >= k; --i) c[i] -= c[i - 1];
  }
  double binomial = 1;
  for (std::size_t k = 1; k < count; ++k) {
    binomial *= static_cast<double>(count - k) / static_cast<double>(k);
    c[k] *= binomial;
  }
  double low = 0, high = 1;
  double share = (static_cast<double>(beyond - 1) + part) / static_cast<double>(count - 1);
  while (high - low > kZeroWithin) {
    double value = 0, slope = 0, curve = 0;  // half of the second derivative
    for (std::size_t k = count; k-- > 0;) {
      curve = curve * share + slope;
      slope = slope * share + value;
      value = value * share + c[k];
    }
    (side * value > 0 ? low : high) = share;
    const double step = -value * slope / (slope * slope - value * curve);
    if (std::abs(step) <= kLastStep * share) return share + step;
    const double next = share + step;
    share = next > low && next < high ? next : (low + high) / 2;
  }
  return share;
}

int changes_of_sign(const Coefficients& b, std::size_t count) {
  int changes = 0;
  for (std::size_t k = 1; k < count; ++k) changes += (b[k] > 0) != (b[k - 1] > 0) ? 1 : 0;
  return changes;
}

/// The first change of side on the part [from, from + width], of which b are the coefficients.
std::optional<double> change_within(const Coefficients& b, std::size_t count, int side, double zero,
                                    double from, double width) {
  bool stays = true;
  for (std::size_t k = 0; k < count; ++k) stays = stays && side * b[k] >= -zero;
  if (stays) return std::nullopt;
  if (width <= kZeroWithin) return from + width;
  if (side * b[0] > 0 && side * b[count - 1] < -zero && changes_of_sign(b, count) == 1)
    return from + width * (count == kFull ? only_zero(b, kFull, side) : only_zero(b, count, side));
  Coefficients left, right;
  split(b, count, left, right);
  if (const auto found = change_within(left, count, side, zero, from, width / 2)) return found;
  return change_within(right, count, side, zero, from + width / 2, width / 2);
}

}  // namespace

StepPolynomial::StepPolynomial(std::span<const double> b, double error)
    : count_(b.size()), error_(error) {
  std::ranges::copy(b, b_.begin());
}

StepPolynomial StepPolynomial::negated() const {
  StepPolynomial other = *this;
  for (double& one : other.b_) one = -one;
  return other;
}

double StepPolynomial::operator()(double share) const { return at(b_, count_, share); }

double StepPolynomial::largest() const { return std::ranges::max(coefficients()); }

StepPolynomial::Highest StepPolynomial::highest() const {
  Highest highest{b_[0], b_[0]};
  widen(b_, count_, 10, highest);
  highest.most = std::max(highest.most, highest.attained);
  return highest;
}

double StepPolynomial::rise() const { return rise_of(b_, count_, 6); }

bool StepPolynomial::falls(double margin) const {
  return count_ > 1 ? falls_within(b_, count_, margin, 6) : margin <= 0;
}

std::optional<double> StepPolynomial::first_change(int side, double zero) const {
  for (std::size_t k = 0; side == 0 && k < count_; ++k)
    if (std::abs(b_[k]) > zero) side = b_[k] > 0 ? 1 : -1;
  if (side == 0) return std::nullopt;
  return change_within(b_, count_, side, zero, 0, 1);
}

}  // namespace gainsmith::pieces
