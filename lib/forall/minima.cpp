#include "forall/minima.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>

namespace gainsmith::forall {

namespace {

/// The values of a curve at points that are refined where a minimum may hide.
class Samples {
 public:
  Samples(const Curve& curve, double low, double high) : curve_(curve) {
    constexpr int kFirst = 48;
    constexpr double kGolden = 0.6180339887498949;
    constexpr double kShift = 0.6;  // of a piece: no wave is met at one phase everywhere
    evaluate(low);
    evaluate(high);
    for (int i = 1; i < kFirst; ++i) {
      const double shift = kShift * (std::fmod(i * kGolden, 1.0) - 0.5);
      evaluate(low + (high - low) * (i + shift) / kFirst);
    }
    const std::map<double, double> first = values_;
    for (auto left = first.begin(); std::next(left) != first.end(); ++left)
      refine(left->first, std::next(left)->first, 0);
  }

  const std::map<double, double>& values() const { return values_; }

 private:
  double evaluate(double at) {
    const double value = curve_.value(at);
    values_.emplace(at, value);
    lowest_ = std::min(lowest_, value);
    return value;
  }

  /// Halves [left, right] as long as the lowest minimum may hide in it: min(a, b, m) - 4 bend <=
  /// lowest, with a, b, m the values at the ends and the middle and bend = |m - (a + b)/2|. It ends
  /// where bend is rounding (1e-10 of the values) or small beside min(a, b, m) - lowest (1e-3).
  void refine(double left, double right, int depth) {
    constexpr int kDeepest = 24;
    constexpr double kSafety = 4;
    constexpr double kResolved = 1e-10;
    const double middle = left + (right - left) / 2;
    const double a = values_.at(left);
    const double b = values_.at(right);
    if (!(left < middle && middle < right)) return;
    const double m = evaluate(middle);
    // A parabola through the three points dips below the lowest of them by less than the bend.
    const double bend = std::abs(m - 0.5 * (a + b));
    if (depth == kDeepest) return;
    if (std::min({a, b, m}) - kSafety * bend > lowest_) return;
    if (bend <= kResolved * std::max(std::abs(a), std::abs(b))) return;
    if (depth > 0 && bend <= 1e-3 * std::abs(std::min({a, b, m}) - lowest_)) return;
    refine(left, middle, depth + 1);
    refine(middle, right, depth + 1);
  }

  const Curve& curve_;
  std::map<double, double> values_;
  double lowest_ = std::numeric_limits<double>::infinity();
};

/// The crossing from falling to rising in [left, right], by regula falsi with halved weights
/// (Illinois), and bisection when it lags.
double stationary_point(const Curve& curve, double left, double right) {
  constexpr int kMost = 80;
  double slope_left = curve.slope(left);
  double slope_right = curve.slope(right);
  if (!(slope_left < 0)) return left;
  if (!(slope_right > 0)) return right;
  int side = 0;
  for (int i = 0; i < kMost && right - left > 4e-16 * (std::abs(left) + std::abs(right)); ++i) {
    double at = (left * slope_right - right * slope_left) / (slope_right - slope_left);
    if (i % 3 == 2 || !(left < at && at < right)) at = left + (right - left) / 2;
    if (!(left < at && at < right)) break;
    const double slope = curve.slope(at);
    if (slope == 0) return at;
    if (slope < 0) {
      left = at;
      slope_left = slope;
      if (side == -1) slope_right /= 2;
      side = -1;
    } else {
      right = at;
      slope_right = slope;
      if (side == 1) slope_left /= 2;
      side = 1;
    }
  }
  return left + (right - left) / 2;
}

}  // namespace

std::vector<CurveMinimum> local_minima(const Curve& curve, double low, double high) {
  if (low == high) return {{low, curve.value(low)}};
  const Samples samples(curve, low, high);
  const auto& values = samples.values();
  std::vector<CurveMinimum> minima;
  for (auto here = values.begin(); here != values.end(); ++here) {
    const auto before = here == values.begin() ? here : std::prev(here);
    const auto after = std::next(here) == values.end() ? here : std::next(here);
    // Of equal neighbours the first counts.
    if (before != here && before->second <= here->second) continue;
    if (after->second < here->second) continue;
    CurveMinimum found{here->first, here->second};
    const double at = stationary_point(curve, before->first, after->first);
    if (const double value = curve.value(at); value <= found.value) found = {at, value};
    minima.push_back(found);
  }
  return minima;
}

namespace {

using BoxFunction = std::function<double(const std::vector<double>&)>;

/// Pattern search: a step along each coordinate while it helps, then half the step.
BoxMinimum descend(const BoxFunction& f, BoxMinimum start, const std::vector<double>& low,
                   const std::vector<double>& high, double first_step) {
  // Of the edges of the box.
  constexpr double kLast = 1e-10;
  double step = first_step;
  while (step > kLast) {
    for (bool better = true; better;) {
      better = false;
      for (std::size_t i = 0; i < low.size(); ++i) {
        for (const double sign : {-1.0, 1.0}) {
          std::vector<double> at = start.at;
          at[i] = std::clamp(at[i] + sign * step * (high[i] - low[i]), low[i], high[i]);
          if (at[i] == start.at[i]) continue;
          const double value = f(at);
          if (!(value < start.value)) continue;
          start = {std::move(at), value};
          better = true;
        }
      }
    }
    step /= 2;
  }
  return start;
}

/// The values of a function on a regular grid, the first coordinate fastest.
class Grid {
 public:
  Grid(const BoxFunction& f, const std::vector<double>& low, const std::vector<double>& high)
      : dimensions_(low.size()) {
    // Of the grid in all; at least two values a coordinate.
    constexpr double kPoints = 1200;
    const double side = std::pow(kPoints, 1.0 / static_cast<double>(dimensions_));
    side_ = std::max<std::size_t>(2, static_cast<std::size_t>(side));
    std::size_t count = 1;
    for (std::size_t i = 0; i < dimensions_; ++i) count *= side_;
    for (std::size_t which = 0; which < count; ++which) {
      std::vector<double> at;
      for (std::size_t i = 0, rest = which; i < dimensions_; ++i, rest /= side_) {
        const std::size_t step = rest % side_;
        at.push_back(step + 1 == side_
                         ? high[i]
                         : low[i] + (high[i] - low[i]) * static_cast<double>(step) * spacing());
      }
      const double found = f(at);
      points_.push_back({std::move(at), found});
    }
  }

  /// As a fraction of the edges.
  double spacing() const { return 1.0 / static_cast<double>(side_ - 1); }

  /// The points that are no higher than their neighbours along each coordinate, and lower than
  /// those before them.
  /// Of equal neighbours the first counts.
  std::vector<BoxMinimum> local_minima() const {
    std::vector<BoxMinimum> minima;
    for (std::size_t which = 0; which < points_.size(); ++which)
      if (is_minimum(which)) minima.push_back(points_[which]);
    return minima;
  }

 private:
  bool is_minimum(std::size_t which) const {
    const double here = points_[which].value;
    std::size_t stride = 1;
    for (std::size_t i = 0; i < dimensions_; ++i, stride *= side_) {
      const std::size_t step = which / stride % side_;
      if (step > 0 && !(here < points_[which - stride].value)) return false;
      if (step + 1 < side_ && !(here <= points_[which + stride].value)) return false;
    }
    return true;
  }

  std::size_t dimensions_;
  std::size_t side_ = 2;
  std::vector<BoxMinimum> points_;
};

}  // namespace

std::vector<BoxMinimum> local_minima(const BoxFunction& value, const std::vector<double>& low,
                                     const std::vector<double>& high) {
  constexpr std::size_t kStarts = 32;
  const Grid grid(value, low, high);
  std::vector<BoxMinimum> minima = grid.local_minima();
  const auto is_lower = [](const BoxMinimum& a, const BoxMinimum& b) { return a.value < b.value; };
  std::stable_sort(minima.begin(), minima.end(), is_lower);
  if (minima.size() > kStarts) minima.resize(kStarts);
  for (BoxMinimum& minimum : minima) minimum = descend(value, minimum, low, high, grid.spacing());
  std::stable_sort(minima.begin(), minima.end(), is_lower);
  return minima;
}

}  // namespace gainsmith::forall
