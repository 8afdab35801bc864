#include "search/axis.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace gainsmith::search {

namespace {

/// log(a / b), in units that are powers of two apart the same bits.
double log_ratio(double a, double b) {
  const double ratio = a / b;
  return std::isfinite(ratio) && ratio > 0 ? std::log(ratio) : std::log(a) - std::log(b);
}

/// low e^x.
double grown(double low, double x) {
  const double factor = std::exp(x);
  return std::isfinite(factor) ? low * factor : std::exp(std::log(low) + x);
}

}  // namespace

double Axis::at(double fraction) const {
  if (fraction <= 0) return low;
  if (fraction >= 1) return high;
  const double value =
      logarithmic ? grown(low, log_ratio(high, low) * fraction) : low + (high - low) * fraction;
  return std::clamp(value, low, high);
}

double Axis::fraction(double value) const {
  if (!(high > low) || !(value > low)) return 0;
  const double part =
      logarithmic ? log_ratio(value, low) / log_ratio(high, low) : (value - low) / (high - low);
  return std::clamp(part, 0.0, 1.0);
}

Axis axis(double low, double high) {
  // Two decades.
  constexpr double kWide = 100;
  return {low, high, low > 0 && high / low >= kWide};
}

std::vector<double> points_on(const Axis& axis, int count) {
  if (count == 1) return {axis.at(0.5)};
  std::vector<double> points;
  points.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i)
    points.push_back(axis.at(static_cast<double>(i) / static_cast<double>(count - 1)));
  return points;
}

std::vector<std::vector<double>> grid(const std::vector<std::vector<double>>& values) {
  std::vector<std::vector<double>> points = {{}};
  for (const std::vector<double>& axis : values) {
    std::vector<std::vector<double>> longer;
    longer.reserve(points.size() * axis.size());
    for (const std::vector<double>& point : points) {
      for (const double value : axis) {
        longer.push_back(point);
        longer.back().push_back(value);
      }
    }
    points = std::move(longer);
  }
  return points;
}

}  // namespace gainsmith::search
