// A range of one scalar, on a linear or logarithmic scale.
#pragma once

#include <vector>

namespace gainsmith::search {

struct Axis {
  double low = 0;
  double high = 1;
  bool logarithmic = false;  ///< needs low > 0

  /// The value at a fraction of the range, from low (0) to high (1), on the axis's scale. The ends
  /// are exact.
  double at(double fraction) const;
  /// The inverse of at(): the fraction of a value, within [0, 1].
  double fraction(double value) const;

  bool operator==(const Axis&) const = default;
};

/// The axis from low to high: logarithmic when low > 0 and high/low >= 100.
Axis axis(double low, double high);

/// `count` values from low to high on the axis's scale, both ends among them; one alone is the
/// middle.
std::vector<double> points_on(const Axis& axis, int count);

/// All combinations of the values of the axes; the last axis runs fastest.
std::vector<std::vector<double>> grid(const std::vector<std::vector<double>>& values);

}  // namespace gainsmith::search
