#include "lmi/minima.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>

namespace gainsmith::lmi {

namespace {

/// The values of a curve at points that are refined where a minimum may hide.
class Samples {
 public:
  Samples(const Curve& curve, double low, double high) : curve_(curve) {
    constexpr int kFirst = 48;
    for (int i = 0; i <= kFirst; ++i)
      evaluate(i == kFirst ? high : low + (high - low) * i / kFirst);
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

  void refine(double left, double right, int depth) {
    constexpr int kDeepest = 24;
    constexpr double kSafety = 4;
    constexpr double kResolved = 1e-10;
    const double middle = left + (right - left) / 2;
    if (depth == kDeepest || !(left < middle && middle < right)) return;
    const double a = values_.at(left);
    const double b = values_.at(right);
    const double m = evaluate(middle);
    // A parabola through the three points dips below the lowest of them by less than the bend.
    const double bend = std::abs(m - 0.5 * (a + b));
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
  constexpr double kLast = 1e-10;
  for (double step = first_step; step > kLast; step /= 2) {
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
  }
  return start;
}

}  // namespace

std::vector<BoxMinimum> local_minima(const BoxFunction& value, const std::vector<double>& low,
                                     const std::vector<double>& high) {
  constexpr double kGridPoints = 1200;
  constexpr std::size_t kStarts = 8;
  const std::size_t n = low.size();
  const int side =
      std::max(3, static_cast<int>(std::pow(kGridPoints, 1.0 / static_cast<double>(n))));
  std::vector<BoxMinimum> grid;
  std::vector<int> index(n, 0);
  for (bool more = true; more;) {
    std::vector<double> at(n);
    for (std::size_t i = 0; i < n; ++i)
      at[i] = index[i] + 1 == side ? high[i] : low[i] + (high[i] - low[i]) * index[i] / (side - 1);
    const double found = value(at);
    grid.push_back({std::move(at), found});
    more = false;
    for (std::size_t i = 0; i < n && !more; ++i) {
      more = ++index[i] < side;
      if (!more) index[i] = 0;
    }
  }
  const auto is_lower = [](const BoxMinimum& a, const BoxMinimum& b) { return a.value < b.value; };
  std::stable_sort(grid.begin(), grid.end(), is_lower);
  const double spacing = 1.0 / (side - 1);
  std::vector<BoxMinimum> minima;
  for (const BoxMinimum& start : grid) {
    if (minima.size() == kStarts) break;
    // A neighbour of a start that was taken leads to the same minimum.
    const auto is_covered = [&](const BoxMinimum& other) {
      for (std::size_t i = 0; i < n; ++i)
        if (std::abs(other.at[i] - start.at[i]) > 2.5 * spacing * (high[i] - low[i])) return false;
      return true;
    };
    if (std::any_of(minima.begin(), minima.end(), is_covered)) continue;
    minima.push_back(start);
  }
  for (BoxMinimum& minimum : minima) minimum = descend(value, minimum, low, high, spacing);
  std::stable_sort(minima.begin(), minima.end(), is_lower);
  return minima;
}

}  // namespace gainsmith::lmi
