// Searches over a few scalars, where each value is expensive, such as the optimum of a semidefinite
// program.
//
//   bisect.h        the largest or smallest value of one scalar with the answer yes
//   minimize.h      the least value of a function of a few, which may have no value at a point
//   optimizers.h    what NLopt (nlopt.h: Nelder & Mead 1965, Powell's BOBYQA 2009, Price 1983)
//                   and Ipopt (ipopt.h: Waechter & Biegler 2006) do for them
//   known_values.h  answers that are kept from search to search
// Nothing here knows of inequalities. All searches are deterministic, for any number of threads.
//
// In this file: a range of one scalar, on a linear or logarithmic scale.
#pragma once

#include <vector>

namespace gainsmith::search {

struct Axis {
  double low = 0;
  double high = 1;
  bool logarithmic = false;  ///< needs low > 0

  /// The value at a fraction of the range, from low (0) to high (1), on the axis's scale. The ends
  /// are exact.
  /// low + f (high - low), or low (high/low)^f.
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
