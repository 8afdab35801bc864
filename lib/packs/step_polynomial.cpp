#include "packs/step_polynomial.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace gainsmith::packs {

namespace {

using Coefficients = std::array<double, 6>;

/// A search for a root ends so near to it.
constexpr double kRootWithin = 2e-15;
/// After a step of Halley's method that is such a part of the root, the digits triple.
constexpr double kLastStep = 1e-5;

/// On its two halves.
void split(const Coefficients& b, Coefficients& left, Coefficients& right) {
  left = right = b;
  for (std::size_t level = 1; level < b.size(); ++level) {
    for (std::size_t k = b.size() - 1; k >= level; --k) left[k] = (left[k] + left[k - 1]) / 2;
    for (std::size_t k = 0; k < b.size() - level; ++k) right[k] = (right[k] + right[k + 1]) / 2;
  }
}

/// Widens what the polynomial attains, at the ends of halves of halves, and what it is not above,
/// their coefficients. Parts that cannot attain more are left out.
void widen(const Coefficients& b, int depth, StepPolynomial::Highest& highest) {
  highest.attained = std::max({highest.attained, b.front(), b.back()});
  const double largest = *std::max_element(b.begin(), b.end());
  if (largest <= highest.attained) return;
  if (depth == 0) {
    highest.most = std::max(highest.most, largest);
    return;
  }
  Coefficients left, right;
  split(b, left, right);
  widen(left, depth - 1, highest);
  widen(right, depth - 1, highest);
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

lanes::LaneCode StepPolynomials::code(std::size_t count) {
  using numbers::ScalarOp;
  numbers::ScalarGraph graph;
  const auto times = [&](double factor, int a) {
    return graph.multiply(graph.constant(factor), a);
  };
  const auto input = [&](std::size_t k) { return graph.input(static_cast<int>(k)); };
  const int length = input(0);
  std::vector<std::vector<int>> results;
  for (std::size_t k = 0; k < count; ++k) {
    const auto of = [&](InputOfValue which) { return input(input_of(k, which)); };
    const auto weighted = [&](const Coefficients& weights, const std::array<int, 6>& b) {
      int sum = times(weights[0], b[0]);
      for (std::size_t i = 1; i < b.size(); ++i) sum = graph.add(times(weights[i], b[i]), sum);
      return sum;
    };
    std::array<int, 6> b{};
    b[0] = of(start);
    b[5] = of(end);
    b[1] = graph.add(graph.multiply(length, times(0.2, of(start_rate))), b[0]);
    b[4] = graph.subtract(b[5], graph.multiply(length, times(0.2, of(end_rate))));
    // The value in the middle gives the sum of both others, the rate there their difference.
    const int others = graph.add(graph.add(b[0], b[5]), times(5, graph.add(b[1], b[4])));
    const int sum = times(0.05, graph.subtract(times(32, of(middle)), others));
    const int apart = graph.add(graph.subtract(b[0], b[5]), times(3, graph.subtract(b[1], b[4])));
    const int difference =
        times(0.25, graph.add(graph.multiply(length, times(3.2, of(middle_rate))), apart));
    b[2] = graph.subtract(sum, difference);
    b[3] = graph.add(sum, difference);
    constexpr Coefficients quarter_weights = {243.0 / 1024, 405.0 / 1024, 270.0 / 1024,
                                              90.0 / 1024,  15.0 / 1024,  1.0 / 1024};
    const auto off = [&](const std::array<int, 6>& from, InputOfValue which) {
      return graph.apply(ScalarOp::abs, graph.subtract(weighted(quarter_weights, from), of(which)));
    };
    const std::array<int, 6> mirrored = {b[5], b[4], b[3], b[2], b[1], b[0]};
    const int fifth = graph.apply(ScalarOp::abs, weighted({-1, 5, -10, 10, -5, 1}, b));
    const int most = graph.apply(ScalarOp::maximum, off(b, quarter), off(mirrored, three_quarters));
    const int error = graph.apply(ScalarOp::maximum, times(0.15 / 32, fifth), times(2, most));
    results.push_back({b[1], b[2], b[3], b[4], error});
  }
  return {graph, results, 1 + count * inputs};
}

StepPolynomial::StepPolynomial(lanes::LaneMachine& made, std::size_t value, std::size_t lane) {
  b_[0] = made.input(StepPolynomials::input_of(value, StepPolynomials::start))[lane];
  b_[5] = made.input(StepPolynomials::input_of(value, StepPolynomials::end))[lane];
  for (std::size_t k = 1; k < 5; ++k) b_[k] = made.result(value, k - 1)[lane];
  error_ = made.result(value, 4)[lane];
}

StepPolynomial StepPolynomial::negated() const {
  StepPolynomial other = *this;
  for (double& one : other.b_) one = -one;
  return other;
}

double StepPolynomial::operator()(double share) const {
  Coefficients b = b_;
  for (std::size_t level = b.size() - 1; level > 0; --level)  // de Casteljau
    for (std::size_t k = 0; k < level; ++k) b[k] += share * (b[k + 1] - b[k]);
  return b[0];
}

double StepPolynomial::largest() const { return *std::max_element(b_.begin(), b_.end()); }

StepPolynomial::Highest StepPolynomial::highest() const {
  Highest highest{b_.front(), b_.front()};
  widen(b_, 10, highest);
  highest.most = std::max(highest.most, highest.attained);
  return highest;
}

double StepPolynomial::rise() const { return rise_of(b_, 6); }

bool StepPolynomial::falls(double margin) const { return falls_within(b_, margin, 6); }

double StepPolynomial::root(int side) const {
  const Coefficients& b = b_;
  // The coefficients are near the polynomial: it comes to 0 about where they do.
  std::size_t beyond = 2;
  while (beyond + 1 < b.size() && side * b[beyond] > 0) ++beyond;
  const double before_it = side * b[beyond - 1];
  const double part = before_it > 0 ? before_it / (before_it - side * b[beyond]) : 0.5;
  const std::array<double, 5> d = {b[1] - b[0], b[2] - b[1], b[3] - b[2], b[4] - b[3], b[5] - b[4]};
  const double c1 = 5 * d[0], c2 = 10 * (d[1] - d[0]), c3 = 10 * (d[2] - 2 * d[1] + d[0]);
  const double c4 = 5 * (d[3] - 3 * (d[2] - d[1]) - d[0]);
  const double c5 = d[4] - 4 * (d[3] + d[1]) + 6 * d[2] + d[0];
  double low = 0, high = 1, at = (static_cast<double>(beyond - 1) + part) / 5;
  while (high - low > kRootWithin) {
    const double value = b[0] + at * (c1 + at * (c2 + at * (c3 + at * (c4 + at * c5))));
    const double slope = c1 + at * (2 * c2 + at * (3 * c3 + at * (4 * c4 + at * 5 * c5)));
    (side * value > 0 ? low : high) = at;
    const double curve = 2 * c2 + at * (6 * c3 + at * (12 * c4 + at * 20 * c5));
    const double step = -2 * value * slope / (2 * slope * slope - value * curve);  // Halley
    if (std::abs(step) <= kLastStep * at) return at + step;
    at = at + step > low && at + step < high ? at + step : (low + high) / 2;
  }
  return at;
}

std::optional<double> first_root(const std::array<double, 5>& values) {
  std::size_t after = 1;
  while (after < values.size() && (values[after] > 0) == (values[0] > 0)) ++after;
  if (after == values.size()) return std::nullopt;
  // Newton's form of the quartic, in quarters.
  std::array<double, 5> d = values;
  for (std::size_t order = 1; order < d.size(); ++order)
    for (std::size_t k = d.size() - 1; k >= order; --k)
      d[k] = (d[k] - d[k - 1]) / static_cast<double>(order);
  double low = static_cast<double>(after - 1), high = static_cast<double>(after);
  while (high - low > kRootWithin) {
    const double x = (low + high) / 2;
    const double value = d[0] + x * (d[1] + (x - 1) * (d[2] + (x - 2) * (d[3] + (x - 3) * d[4])));
    ((value > 0) == (values[0] > 0) ? low : high) = x;
  }
  return (low + high) / 8;
}

}  // namespace gainsmith::packs
