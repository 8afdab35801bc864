#include "search/axis.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace gainsmith::search {

// Both ways only know of ratios to `low`: in units that are powers of two apart the same bits.
double Axis::at(double fraction) const {
  if (fraction <= 0) return low;
  if (fraction >= 1) return high;
  const double value =
      logarithmic ? low * std::exp(std::log(high / low) * fraction) : low + (high - low) * fraction;
  return std::clamp(value, low, high);
}

double Axis::fraction(double value) const {
  if (!(high > low) || !(value > low)) return 0;
  const double part =
      logarithmic ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
  return std::clamp(part, 0.0, 1.0);
}

Axis axis(double low, double high) {
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
