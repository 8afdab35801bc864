#include "response/time_response.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "numbers/dense.h"

namespace gainsmith::response {

double duration_of(const StateSpace& system) {
  constexpr double kConstants = 7, kGrowth = 100, kWithout = 10;
  const Matrix all = poles(system);
  double slowest = std::numeric_limits<double>::infinity(), fastest = 0;
  for (Eigen::Index k = 0; k < all.rows(); ++k) {
    double rate = all(k, 0);
    if (system.is_sampled()) {
      const double size = std::hypot(all(k, 0), all(k, 1));
      if (size == 0) continue;
      rate = std::log(size) / system.step;
    }
    if (rate < 0) slowest = std::min(slowest, -rate);
    if (rate > 0) fastest = std::max(fastest, rate);
  }
  if (fastest > 0) return std::log(kGrowth) / fastest;
  const double least = system.is_sampled() ? kWithout * system.step : 0;
  if (std::isfinite(slowest)) return std::max(kConstants / slowest, least);
  return system.is_sampled() ? kConstants * kWithout * system.step : kWithout;
}

TimeResponse time_response(const StateSpace& system, Stimulus stimulus, Eigen::Index input,
                           double until, int points) {
  const Eigen::Index n = system.states();
  TimeResponse result;
  const bool sampled = system.is_sampled();
  const bool is_step = stimulus == Stimulus::step;
  constexpr int kMost = 100'000;
  const int count =
      sampled ? static_cast<int>(std::min<double>(kMost, std::floor(until / system.step))) + 1
              : points;
  const double length = sampled ? system.step : until / (points - 1);
  // x and u after a time of this length.
  Matrix whole = Matrix::Zero(n + 1, n + 1);
  whole.topLeftCorner(n, n) = system.A;
  whole.topRightCorner(n, 1) = system.B.col(input);
  Matrix over = whole;
  if (!sampled) over = numbers::exponential(whole * length);
  over(n, n) = sampled && !is_step ? 0 : 1;
  numbers::Vector z = numbers::Vector::Zero(n + 1);
  if (is_step || sampled) z(n) = sampled && !is_step ? 1 / system.step : 1;
  if (!is_step && !sampled) z.head(n) = system.B.col(input);
  Matrix out(system.outputs(), n + 1);
  out << system.C, system.D.col(input);
  result.y.resize(system.outputs(), count);
  for (int k = 0; k < count; ++k) {
    result.t.push_back(k * length);
    result.y.col(k) = out * z;
    z = over * z;
  }
  return result;
}

StepFacts step_facts(const StateSpace& system, const TimeResponse& step) {
  const Eigen::Index n = system.states();
  const Matrix still =
      system.is_sampled() ? Matrix(Matrix::Identity(n, n) - system.A) : Matrix(-system.A);
  StepFacts facts;
  facts.final_value =
      system.D(0, 0) + (n == 0 ? 0 : (system.C * still.partialPivLu().solve(system.B))(0, 0));
  const double end = facts.final_value;
  // The time at which the line through the samples passes a share of it, first or last.
  const auto share = [&](Eigen::Index k) { return step.y(0, k) / end; };
  const auto between = [&](Eigen::Index k, double level) {
    const double a = share(k - 1), b = share(k);
    const auto at = static_cast<std::size_t>(k);
    return step.t[at - 1] + (step.t[at] - step.t[at - 1]) * (level - a) / (b - a);
  };
  double most = 0, low = 0, high = 0;
  bool passed_low = false, passed_high = false;
  for (Eigen::Index k = 0; k < step.y.cols(); ++k) {
    most = std::max(most, share(k));
    if (!passed_low && share(k) >= 0.1) {
      passed_low = true;
      low = k == 0 ? 0 : between(k, 0.1);
    }
    if (!passed_high && share(k) >= 0.9) {
      passed_high = true;
      high = k == 0 ? 0 : between(k, 0.9);
    }
    if (std::abs(share(k) - 1) > 0.02 && k + 1 < step.y.cols())
      facts.settling = std::abs(share(k + 1) - 1) > 0.02
                           ? step.t[static_cast<std::size_t>(k + 1)]
                           : between(k + 1, share(k) > 1 ? 1.02 : 0.98);
  }
  facts.overshoot = std::max(most - 1, 0.0);
  facts.rise = high - low;
  return facts;
}

}  // namespace gainsmith::response
