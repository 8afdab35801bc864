#include "response/time_response.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "numbers/dense/dense.h"

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
  // z = [x; u], (n + 1) x 1. A step is u = 1, an impulse x(0) = b; of a sampled system it is
  // u = 1/T in the first step.
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

namespace {

/// A mode s as a rate -Re s at which it dies out and a speed |s| at which it moves; of a sampled
/// system -log |z| and 1, per step.
struct Speed {
  double rate = 0, speed = 0;
};

/// The slowest last; modes at z = 0 are gone after n steps.
std::vector<Speed> speeds_of(const StateSpace& system) {
  std::vector<Speed> all;
  const Matrix roots = poles(system);
  for (Eigen::Index k = 0; k < roots.rows(); ++k) {
    const double size = std::hypot(roots(k, 0), roots(k, 1));
    if (!system.is_sampled())
      all.push_back({-roots(k, 0), size});
    else if (size > 0)
      all.push_back({-std::log(size), 1});
  }
  std::sort(all.begin(), all.end(), [](const Speed& a, const Speed& b) { return a.rate > b.rate; });
  return all;
}

/// Reads the facts from values that come one after the other. Between them a continuous output
/// is a line where it crosses a level, and a parabola at its extremes; a sampled one has no values.
class StepReader {
 public:
  StepReader(double end, bool sampled) : end_(end), sampled_(sampled) {}

  void read(double t, double y) {
    if (!sampled_ && count_ >= 2) meet_between(t, y);
    meet(t, y);
    first(0.1, t, y, low_);
    first(0.9, t, y, high_);
    if (!(std::abs(y / end_ - 1) <= kBand))
      outside_ = true;
    else if (outside_) {
      settling_ = crossing(last_ / end_ > 1 ? 1 + kBand : 1 - kBand, t, y);
      outside_ = false;
    }
    before_ = last_;
    before_at_ = last_at_;
    last_ = y;
    last_at_ = t;
    ++count_;
  }
  StepFacts facts() const {
    const bool falls = std::abs(least_) > most_;
    const double top = (end_ > 0 ? most_ : least_) / end_, dip = (end_ > 0 ? least_ : most_) / end_;
    return {end_,
            falls ? least_ : most_,
            falls ? least_at_ : most_at_,
            std::max(top - 1, 0.0),
            std::max(-dip, 0.0),
            high_.value_or(0) - low_.value_or(0),
            settling_};
  }

 private:
  /// Settled: |y/end - 1| is not above it.
  static constexpr double kBand = 0.02;

  void meet(double t, double y) {
    if (y > most_) {
      most_ = y;
      most_at_ = t;
    }
    if (y < least_) {
      least_ = y;
      least_at_ = t;
    }
  }
  /// The vertex of the parabola through the last three values, where the middle one is an extreme.
  void meet_between(double t, double y) {
    const double length = t - last_at_;
    constexpr double kEqual = 1e-9;
    if ((last_ - before_) * (y - last_) >= 0 ||
        std::abs(last_at_ - before_at_ - length) > kEqual * length)
      return;
    const double slope = (y - before_) / 2, bend = before_ - 2 * last_ + y;
    meet(last_at_ - length * slope / bend, last_ - slope * slope / (2 * bend));
  }
  /// When the share of the final value is reached.
  double crossing(double share, double t, double y) const {
    if (sampled_ || count_ == 0 || y == last_) return t;
    return last_at_ + (t - last_at_) * (share * end_ - last_) / (y - last_);
  }
  void first(double share, double t, double y, std::optional<double>& when) const {
    if (!when && y / end_ >= share) when = crossing(share, t, y);
  }

  double end_;
  bool sampled_;
  int count_ = 0;
  double before_ = 0, before_at_ = 0, last_ = 0, last_at_ = 0;
  double most_ = 0, most_at_ = 0, least_ = 0, least_at_ = 0, settling_ = 0;
  bool outside_ = true;
  std::optional<double> low_, high_;
};

}  // namespace

bool StepFacts::ends_at_0() const { return std::abs(final_value) <= 1e-9 * std::abs(largest); }

std::optional<StepFacts> step_facts(const StateSpace& system, Eigen::Index input,
                                    Eigen::Index output) {
  // e^-kDead = 1e-7 is left of a mode; kPart of the time 1/|s| is a step; kMost steps in all.
  // The final value is D - C A^-1 b, of a sampled system D + C (I - A)^-1 b.
  constexpr double kDead = 16, kPart = 0.02, kMost = 2e6;
  const Eigen::Index n = system.states();
  const Matrix still =
      system.is_sampled() ? Matrix(Matrix::Identity(n, n) - system.A) : Matrix(-system.A);
  const numbers::Vector b = system.B.col(input);
  double end = system.D(output, input);
  if (n > 0) end += system.C.row(output).dot(still.partialPivLu().solve(b));
  Matrix out(1, n + 1);
  out << system.C.row(output), system.D(output, input);
  numbers::Vector z = numbers::Vector::Zero(n + 1);
  z(n) = 1;
  Matrix whole = Matrix::Zero(n + 1, n + 1);
  whole.topLeftCorner(n, n) = system.A;
  whole.topRightCorner(n, 1) = b;
  StepReader reader(end, system.is_sampled());
  const auto value = [&] { return (out * z)(0, 0); };
  reader.read(0, value());
  const std::vector<Speed> modes = speeds_of(system);
  double t = 0, steps = 0;
  const auto follow = [&](const Matrix& over, double length, double until) {
    const double count = std::ceil((until - t) / length);
    if (!(count > 0)) return true;
    if (!((steps += count) <= kMost)) return false;
    const double start = t;
    for (double k = 1; k <= count; ++k) {
      z = over * z;
      t = start + k * length;
      reader.read(t, value());
    }
    return true;
  };
  if (system.is_sampled()) {
    whole(n, n) = 1;
    const double last = modes.empty() ? 0 : kDead / modes.back().rate;
    if (!follow(whole, system.step, (last + static_cast<double>(n) + 2) * system.step))
      return std::nullopt;
    return reader.facts();
  }
  for (std::size_t k = 0; k < modes.size(); ++k) {
    double fastest = 0;
    for (std::size_t i = k; i < modes.size(); ++i) fastest = std::max(fastest, modes[i].speed);
    const double length = kPart / fastest;
    if (!follow(numbers::exponential(whole * length), length, kDead / modes[k].rate))
      return std::nullopt;
  }
  return reader.facts();
}

}  // namespace gainsmith::response
