#include "ode/roots.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "ode/chebyshev.h"
#include "ode/tolerances.h"

namespace gainsmith::ode {

namespace {

using Eigen::Index;
using Eigen::RowVectorXd;
using Eigen::VectorXd;
using numbers::Matrix;

/// Of the interpolant.
constexpr int degree = 16;
/// It divides the degree, so that its points are among the others.
constexpr int low_degree = 4;
/// Where the interpolant is compared with g, besides its own last coefficients.
constexpr std::array<double, 2> check_points = {-0.617, 0.443};
constexpr double unit = std::numeric_limits<double>::epsilon();
/// After them an interval is a rounding of itself.
constexpr int most_halvings = 60;

/// sum_k |c_k|, k > 0.
double swing(const Matrix& c) { return c.rightCols(c.cols() - 1).cwiseAbs().sum(); }

bool excludes_roots(const Matrix& c, double slack = 0) { return std::abs(c(0)) > swing(c) + slack; }

class RootSearch {
 public:
  RootSearch(const RootFunction& function, double from, double to)
      : function_(function), from_(from), to_(to) {}

  Found run() {
    scale_ = 0;
    interval(from_, to_, 0);
    std::sort(found_.roots.begin(), found_.roots.end(),
              [](const Root& a, const Root& b) { return a.right < b.right; });
    return std::move(found_);
  }

 private:
  double value(double t) {
    const double g = function_.value(t);
    found_.meets_zero = found_.meets_zero || g == 0;
    return g;
  }
  bool side(double g) const { return function_.strict ? g > 0 : g >= 0; }
  /// How near to 0 a turning point is reported.
  double near() const { return std::max(kTurnsNear * scale_, function_.near); }
  double tolerance() const { return kFinest * scale_ + function_.noise; }
  double resolution(double a, double b) const {
    return 2 * unit * std::max(std::abs(a), std::abs(b)) + unit * unit * (to_ - from_);
  }

  /// The interpolant of a low degree at every fourth of the points, where it agrees to rounding.
  std::optional<Matrix> of_low_degree(double a, double b) {
    const VectorXd& points = chebyshev::points(low_degree);
    RowVectorXd values(points.size());
    for (Index k = 0; k < points.size(); ++k) values(k) = value(chebyshev::outer(points(k), a, b));
    const double largest = values.cwiseAbs().maxCoeff();
    if (!(largest > function_.noise) || b - a <= 4 * resolution(a, b)) return std::nullopt;
    scale_ = largest;
    const Matrix c = chebyshev::coefficients(values);
    if (!agrees(c, a, b, unit * largest + function_.noise)) return std::nullopt;
    return chebyshev::trimmed(c, unit * largest);
  }

  /// Roots of g on [a, b].
  void interval(double a, double b, int halvings) {
    if (halvings == 0)
      if (const auto c = of_low_degree(a, b)) return part(*c, a, b, 0);
    points_ += degree + 1;
    if (points_ > kPatience) {
      found_.whole = false;
      between(a, b);
      return;
    }
    const VectorXd& points = chebyshev::points(degree);
    VectorXd times(points.size());
    RowVectorXd values(points.size());
    for (Index k = 0; k < points.size(); ++k) {
      times(k) = chebyshev::outer(points(k), a, b);
      values(k) = value(times(k));
    }
    const double largest = values.cwiseAbs().maxCoeff();
    if (halvings == 0) scale_ = largest;
    const bool short_enough = b - a <= 4 * resolution(a, b) || halvings >= most_halvings;
    if (largest <= function_.noise || short_enough) {
      by_sides(times);
      return;
    }
    const Matrix c = chebyshev::coefficients(values);
    // Of a short step late in a run times are rounded, which is no corner of g.
    const double rounding = halvings == 0 ? rounding_of_times(c, a, b) : 0;
    if (agrees(c, a, b, tolerance() + rounding)) {
      // What rounding has left of higher degrees is no part of g.
      part(chebyshev::trimmed(c, unit * largest), a, b, 0);
      return;
    }
    if (stays_away(values)) return;
    const double middle = times(degree / 2);
    interval(a, middle, halvings + 1);
    interval(middle, b, halvings + 1);
  }

  bool agrees(const Matrix& c, double a, double b, double most) {
    if (c.rightCols(2).cwiseAbs().sum() > most) return false;
    return std::all_of(check_points.begin(), check_points.end(), [&](double x) {
      return std::abs(value(chebyshev::outer(x, a, b)) - chebyshev::first(c, x)) <= most;
    });
  }

  /// What the rounding of times makes of g: |T_k'| <= k^2.
  double rounding_of_times(const Matrix& c, double a, double b) const {
    double slope = 0;
    for (Index k = 1; k < c.cols(); ++k) slope += static_cast<double>(k * k) * std::abs(c(k));
    return slope * resolution(a, b) / (b - a) * 2;
  }

  /// A function with corners that changes little from point to point, and lies beyond that.
  bool stays_away(const RowVectorXd& values) const {
    const double step = (values.rightCols(degree) - values.leftCols(degree)).cwiseAbs().maxCoeff();
    const double nearest = values.cwiseAbs().minCoeff();
    return nearest > 2 * step && nearest > near() && values.minCoeff() * values.maxCoeff() > 0;
  }

  void by_sides(const VectorXd& times) {
    for (Index k = 0; k + 1 < times.size(); ++k) between(times(k), times(k + 1));
  }

  /// Roots of g on [a, b], on which c is its interpolant.
  void part(const Matrix& c, double a, double b, int halvings) {
    if (excludes_roots(c, near() + function_.noise)) return;
    const Matrix slope = chebyshev::derivative(c);
    const double noise = function_.noise + unit * scale_;
    if (excludes_roots(slope) || swing(c) <= noise || halvings >= most_halvings) {
      between(a, b);
      return;
    }
    if (excludes_roots(chebyshev::derivative(slope))) {
      around_extremum(c, slope, a, b);
      return;
    }
    const double middle = chebyshev::outer(0, a, b);
    part(chebyshev::part(c, -1, 0), a, middle, halvings + 1);
    part(chebyshev::part(c, 0, 1), middle, b, halvings + 1);
  }

  /// Just before the root of a monotone series that is positive on the left, or negative.
  static double root_of(const Matrix& series, bool positive) {
    double low = -1;
    double high = 1;
    while (high - low > unit) {
      const double x = (low + high) / 2;
      ((chebyshev::first(series, x) > 0) == positive ? low : high) = x;
    }
    return low;
  }

  /// Of t and the numbers beside it: rounding may have moved an extremum by one.
  double nearest_to_0(double t, double a, double b) {
    double best = t;
    double least = std::abs(value(t));
    for (const double beside : {std::nextafter(t, a), std::nextafter(t, b)})
      if (const double g = std::abs(value(beside)); g < least) {
        best = beside;
        least = g;
      }
    return best;
  }

  /// Where the slope is monotone: at most two roots.
  void around_extremum(const Matrix& c, const Matrix& slope, double a, double b) {
    const double left = chebyshev::first(slope, -1);
    if ((left > 0) == (chebyshev::first(slope, 1) > 0)) {
      between(a, b);
      return;
    }
    const double low = slope.cols() == 2 ? -slope(0) / slope(1) : root_of(slope, left > 0);
    const double t = nearest_to_0(std::clamp(chebyshev::outer(low, a, b), a, b), a, b);
    const bool found = between(a, t) | between(t, b);
    const double g = value(t);
    // A minimum of |g|: below zero the slope falls, above it rises.
    const bool towards = (chebyshev::first(c, low) > 0) == (left < 0);
    if ((found || towards) && std::abs(g) <= near()) found_.turning_points.push_back({t, g, found});
  }

  struct Point {
    double t = 0;
    double g = 0;
  };
  Point at(double t) { return {t, value(t)}; }

  /// The part of the distance from `last` to `other`, on both sides of the root, to try next: by
  /// inverse quadratic interpolation where it is safe (Chandrupatla 1997), otherwise a half.
  static double next_part(const Point& last, const Point& other, const Point& before) {
    const double xi = (last.t - other.t) / (before.t - other.t);
    const double phi = (last.g - other.g) / (before.g - other.g);
    if (!(phi * phi < xi && (1 - phi) * (1 - phi) < 1 - xi)) return 0.5;
    const double part = last.g / (other.g - last.g) * (before.g / (other.g - before.g)) +
                        (before.t - last.t) / (other.t - last.t) * (last.g / (before.g - last.g)) *
                            (other.g / (before.g - other.g));
    return std::isfinite(part) ? part : 0.5;
  }

  /// The root between a and b where the sides differ.
  bool between(double a, double b) {
    Point last = at(a);
    Point other = at(b);
    if (side(last.g) == side(other.g)) return false;
    double part = 0.5;
    while (true) {
      const double length = std::abs(other.t - last.t);
      const double finest = resolution(last.t, other.t);
      if (length <= finest) break;
      const double least = std::min(finest / length / 2, 0.5);
      const Point middle = at(last.t + std::clamp(part, least, 1 - least) * (other.t - last.t));
      if (middle.t == last.t || middle.t == other.t) break;
      const bool same = side(middle.g) == side(last.g);
      const Point before = same ? last : other;
      if (!same) other = last;
      last = middle;
      part = next_part(last, other, before);
    }
    found_.roots.push_back({std::min(last.t, other.t), std::max(last.t, other.t)});
    return true;
  }

  const RootFunction& function_;
  double from_, to_;
  double scale_ = 0;  ///< the largest |g| on the step
  int points_ = 0;    ///< of all intervals
  Found found_;
};

}  // namespace

Found find_roots(const RootFunction& function, double from, double to) {
  return RootSearch(function, from, to).run();
}

Found find_roots(const RootFunction& function, double from, double to,
                 const std::vector<Break>& breaks) {
  if (breaks.empty()) return find_roots(function, from, to);
  Found all;
  const auto side = [&](double t) {
    const double g = function.value(t);
    all.meets_zero = all.meets_zero || g == 0;
    return function.strict ? g > 0 : g >= 0;
  };
  const auto add = [&](double a, double b) {
    if (!(a < b)) return;
    const Found found = find_roots(function, a, b);
    all.whole = all.whole && found.whole;
    all.meets_zero = all.meets_zero || found.meets_zero;
    all.roots.insert(all.roots.end(), found.roots.begin(), found.roots.end());
    all.turning_points.insert(all.turning_points.end(), found.turning_points.begin(),
                              found.turning_points.end());
  };
  double left = from;
  for (const Break& edge : breaks) {
    add(left, edge.left);
    if (side(edge.left) != side(edge.right)) all.roots.push_back(edge);
    left = edge.right;
  }
  add(left, to);
  return all;
}

std::vector<double> first_points(double from, double to) {
  std::vector<double> times;
  for (const double x : chebyshev::points(degree)) times.push_back(chebyshev::outer(x, from, to));
  for (const double x : check_points) times.push_back(chebyshev::outer(x, from, to));
  std::sort(times.begin(), times.end());
  return times;
}

}  // namespace gainsmith::ode
