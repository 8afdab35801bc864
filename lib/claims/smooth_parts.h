// The parts of a step on which a value is smooth and known from some of its points.
//
// They are the parts between its breaks (hybrid/breaks.h), halved until a polynomial of degree 4, 8
// or 16 through Chebyshev points agrees with the value at two others. It agrees to a part of what
// the value changes by, or to its rounding. So the parts are as short as the text needs them,
// however long the step is: sin(60*t) along a clock. What is narrower than the distance of the
// points of the first polynomials may hide between them.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "claims/run_values.h"
#include "claims/tolerances.h"
#include "ode/chebyshev.h"

namespace gainsmith::claims {

struct SmoothPart {
  double from = 0;
  double to = 0;
  bool after_jump = false;   ///< the value jumps just before it
  bool before_jump = false;  ///< just after it
  /// The value on [from, to] as a sum of Chebyshev polynomials (ode/chebyshev.h).
  Eigen::RowVectorXd series{};
  /// How far the series may be off: to what it agrees, and what rounding of the variables makes of
  /// the value, where that is asked for.
  double noise = 0;
  /// A time at which the value is no number; then there is no series.
  std::optional<double> undefined{};
  bool followed = true;  ///< false: the step, which has more breaks than can be searched

  /// Points as close as the series needs them, both ends among them; at least those of degree 4.
  int points() const { return 1 + 4 * std::max(static_cast<int>(series.size()), 5); }
  double time(int point) const;
  /// The series at t.
  double operator()(double t) const;
  /// At some times at once, with the same bits.
  template <std::size_t n>
  std::array<double, n> operator()(const std::array<double, n>& times) const {
    std::array<double, n> x{}, sum{}, after{};
    for (std::size_t k = 0; k < n; ++k) x[k] = ode::chebyshev::inner(times[k], from, to);
    for (Eigen::Index i = series.size() - 1; i > 0; --i)
      for (std::size_t k = 0; k < n; ++k) {
        const double next = series(i) + 2 * x[k] * sum[k] - after[k];
        after[k] = sum[k];
        sum[k] = next;
      }
    for (std::size_t k = 0; k < n; ++k) sum[k] = series(0) + x[k] * sum[k] - after[k];
    return sum;
  }
};

/// In order, at least one. `near`: takes the places at which it nearly branches. `noise`: whether
/// rounding of the variables is part of the noise.
std::vector<SmoothPart> smooth_parts(RunValue& value, const hybrid::DenseStep& step,
                                     std::vector<double>* near = nullptr,
                                     double agreement = kAgreement, bool noise = false);

/// Where the series of a part turns, in rising order.
std::vector<double> turns_of(const SmoothPart& part);

/// A point of a series, times a sign, that is not below its neighbours.
struct Top {
  double value = 0;
  double rise = 0;  ///< above the lower of its neighbours
  double t = 0, before = 0, after = 0;
};

/// Appends those of a part that has a series, on [from, to] of it.
void add_tops(const SmoothPart& part, double from, double to, double sign, std::vector<Top>& tops);

}  // namespace gainsmith::claims
