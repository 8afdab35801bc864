#include "packs/step_polynomial.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gainsmith::packs {

namespace {

using Coefficients = std::array<double, 6>;

/// A search for a root ends so near to it, or where the value is such a part of the coefficients.
constexpr double kRootWithin = 4e-16;

/// The first `level` coefficients of one degree less, at a share (de Casteljau).
void step_down(Coefficients& b, std::size_t level, double share) {
  for (std::size_t k = 0; k < level; ++k) b[k] += share * (b[k + 1] - b[k]);
}

/// On its two halves.
void split(const Coefficients& b, Coefficients& left, Coefficients& right) {
  left = right = b;
  for (std::size_t level = 1; level < b.size(); ++level) {
    for (std::size_t k = b.size() - 1; k >= level; --k) left[k] = (left[k] + left[k - 1]) / 2;
    for (std::size_t k = 0; k < b.size() - level; ++k) right[k] = (right[k] + right[k + 1]) / 2;
  }
}

/// The largest coefficient once halves, and halves of halves, have no larger one inside than at
/// their ends.
double highest_of(const Coefficients& b, int depth) {
  const double largest = *std::max_element(b.begin(), b.end());
  if (depth == 0 || largest <= std::max(b.front(), b.back())) return largest;
  Coefficients left, right;
  split(b, left, right);
  return std::max(highest_of(left, depth - 1), highest_of(right, depth - 1));
}

/// The sum of all rises, of the coefficients of parts that are so short.
double rise_of(const Coefficients& b, int depth) {
  double rise = 0;
  for (std::size_t k = 1; k < b.size(); ++k) rise += std::max(b[k] - b[k - 1], 0.0);
  if (depth == 0 || rise == 0) return rise;
  Coefficients left, right;
  split(b, left, right);
  return rise_of(left, depth - 1) + rise_of(right, depth - 1);
}

/// Whether the derivative is below -margin on parts that are so short.
bool falls_within(const Coefficients& b, double margin, int depth) {
  const auto rises = [&](std::size_t k) { return b[k] - b[k - 1] > -margin / 5; };
  bool everywhere = true;
  for (std::size_t k = 1; k < b.size(); ++k) everywhere = everywhere && !rises(k);
  if (everywhere) return true;
  if (depth == 0 || rises(1) || rises(b.size() - 1)) return false;
  Coefficients left, right;
  split(b, left, right);
  return falls_within(left, margin / 2, depth - 1) && falls_within(right, margin / 2, depth - 1);
}

}  // namespace

StepPolynomial::StepPolynomial(const StepSamples& samples) {
  const auto& [length, start, middle, end, quarter, three_quarters] = samples;
  b_[0] = start.value;
  b_[1] = start.value + length * start.rate / 5;
  b_[4] = end.value - length * end.rate / 5;
  b_[5] = end.value;
  const double sum = (32 * middle.value - b_[0] - 5 * b_[1] - 5 * b_[4] - b_[5]) / 10;
  const double difference =
      (3.2 * length * middle.rate + b_[0] + 3 * b_[1] - 3 * b_[4] - b_[5]) / 2;
  b_[2] = (sum - difference) / 2;
  b_[3] = (sum + difference) / 2;
  const double fifth = b_[5] - 5 * b_[4] + 10 * b_[3] - 10 * b_[2] + 5 * b_[1] - b_[0];
  error_ = std::fmax(
      0.15 / 32 * std::abs(fifth),
      2 * std::fmax(std::abs((*this)(0.25) - quarter), std::abs((*this)(0.75) - three_quarters)));
}

double StepPolynomial::operator()(double share) const {
  Coefficients b = b_;
  for (std::size_t level = b.size() - 1; level > 0; --level) step_down(b, level, share);
  return b[0];
}

double StepPolynomial::largest() const { return *std::max_element(b_.begin(), b_.end()); }

double StepPolynomial::highest() const { return highest_of(b_, 10); }

double StepPolynomial::rise() const { return rise_of(b_, 6); }

bool StepPolynomial::falls(double margin) const { return falls_within(b_, margin, 6); }

double StepPolynomial::root(int side) const {
  double low = 0, high = 1, at = 0.5, size = 0;
  for (const double one : b_) size = std::fmax(size, std::abs(one));
  for (int k = 0; k < 100; ++k) {
    Coefficients b = b_;
    for (std::size_t level = b.size() - 1; level > 1; --level) step_down(b, level, at);
    const double slope = 5 * (b[1] - b[0]);
    step_down(b, 1, at);
    if (std::abs(b[0]) <= kRootWithin * size) break;
    (side * b[0] > 0 ? low : high) = at;
    const double next = at - b[0] / slope;
    const double before = std::exchange(at, next > low && next < high ? next : (low + high) / 2);
    if (std::abs(at - before) <= kRootWithin * at) break;
  }
  return at;
}

}  // namespace gainsmith::packs
