#include "packs/quintics.h"

#include <vector>

namespace gainsmith::packs {

namespace {

using Coefficients = std::array<double, 6>;

/// A search for a root ends so near to it, in quarters of a step: some units in the last place.
constexpr double kRootWithin = 2e-15;
}  // namespace

/// The coefficients by (1), and the error of each quintic
///
///   max(0.15 |Delta^5 b|/32, 2 max(|p(1/4) - v|, |p(3/4) - v|))
///
/// The fifth difference Delta^5 b is the leading coefficient; quintic() says what both parts
/// estimate. All values of all lanes are one list of operations.
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

/// Ends are read from the inputs, the inner coefficients and the error from the results.
pieces::StepPolynomial quintic(lanes::LaneMachine& made, std::size_t value, std::size_t lane) {
  Coefficients b{};
  b[0] = made.input(StepPolynomials::input_of(value, StepPolynomials::start))[lane];
  b[5] = made.input(StepPolynomials::input_of(value, StepPolynomials::end))[lane];
  for (std::size_t k = 1; k < 5; ++k) b[k] = made.result(value, k - 1)[lane];
  return {b, made.result(value, 4)[lane]};
}

/// Bisection in the first quarter whose ends differ in sign, on Newton's form of the quartic with
/// nodes 0, 1, 2, 3, 4. The result is a share of the step.
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
