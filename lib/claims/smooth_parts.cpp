#include "claims/smooth_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "claims/tolerances.h"
#include "ode/chebyshev.h"

namespace gainsmith::claims {

namespace {

namespace chebyshev = ode::chebyshev;
using Eigen::Index;
using Eigen::RowVectorXd;

/// The degrees that are tried, and two points between those of all polynomials.
constexpr std::array<int, 3> tried_degrees = {4, 8, 16};
constexpr int largest_degree = tried_degrees.back();
constexpr std::array<double, 2> check_points = {-0.617, 0.443};
constexpr int evaluations_of_part = largest_degree + 1 + static_cast<int>(check_points.size());

/// Adaptive interpolation: degrees 4, 8, 16 share their points; a part that none follows is halved.
class Halving {
 public:
  Halving(RunValue& value, const hybrid::DenseStep& step, double agreement)
      : value_(value), step_(step), agreement_(agreement) {
    for (std::size_t k = 0; k < check_points.size(); ++k)
      checks_[k].t = chebyshev::outer(check_points[k], step.from, step.to);
  }

  /// What the rounding of the variables makes of the value: the lesser at two places, since a place
  /// at a break shows the jump there.
  double noise() {
    if (!noise_) noise_ = std::fmin(noise_at(checks_[0]), noise_at(checks_[1]));
    return *noise_;
  }

  /// Appends the parts of a part; what the first half leaves of the patience is the second one's.
  void halve(SmoothPart part, int patience, std::vector<SmoothPart>& parts) {
    const double middle = part.from + (part.to - part.from) / 2;
    const bool is_shortest = !(part.from < middle && middle < part.to);
    if (is_known(part) || is_shortest || evaluations_ + evaluations_of_part > patience) {
      parts.push_back(std::move(part));
      return;
    }
    halve({part.from, middle, part.after_jump, false}, evaluations_ + (patience - evaluations_) / 2,
          parts);
    halve({middle, part.to, false, part.before_jump}, patience, parts);
  }

 private:
  /// Makes its series; whether that is the value, or there is none.
  bool is_known(SmoothPart& part) {
    std::array<double, largest_degree + 1> values{};
    std::array<double, check_points.size()> checks{};
    for (std::size_t k = 0; k < check_points.size(); ++k) checks[k] = at(part, check_points[k]);
    int before = 0;
    for (const int degree : tried_degrees) {
      const int apart = largest_degree / degree;
      for (int k = 0; k <= degree; ++k)
        if (before == 0 || k % 2 == 1)
          values[static_cast<std::size_t>(apart * k)] = at(part, chebyshev::points(degree)(k));
      if (part.undefined) return true;
      before = degree;
      RowVectorXd seen(degree + 1);
      for (int k = 0; k <= degree; ++k) seen(k) = values[static_cast<std::size_t>(apart * k)];
      part.series = chebyshev::coefficients(seen);
      // The last two coefficients, and the error at two points that are no nodes.
      double error = part.series.tail(2).cwiseAbs().sum();
      for (std::size_t k = 0; k < check_points.size(); ++k)
        error = larger(error, std::abs(chebyshev::first(part.series, check_points[k]) - checks[k]));
      part.noise = agreement_ * (seen.maxCoeff() - seen.minCoeff()) +
                   kValueRounding * seen.cwiseAbs().maxCoeff();
      if (error <= part.noise || error <= part.noise + noise()) return true;
    }
    return false;
  }

  /// What is no number stays so.
  static double larger(double a, double b) { return std::isnan(b) || b > a ? b : a; }

  /// A place with the value there, once it is known.
  struct Place {
    double t = 0;
    std::optional<double> value;
  };

  /// In some directions.
  double noise_at(Place& place) {
    const Eigen::VectorXd& x = value_.point(place.t);
    if (!place.value) place.value = value_.number(x);
    const double value = *place.value;
    const Eigen::VectorXd sizes = value_.sizes();
    const std::vector<Index>& used = value_.used();
    Eigen::VectorXd rounded = x;
    double result = 0;
    for (const int period : {1, 2, 4}) {
      for (std::size_t k = 0; k < used.size(); ++k) {
        const Index e = used[k];
        const double rounding = e / period % 2 == 0 ? kValueRounding : -kValueRounding;
        rounded(e) = x(e) + rounding * sizes(static_cast<Index>(k));
      }
      result = std::fmax(result, std::abs(value_.number(rounded) - value));
    }
    return result;
  }

  double at(SmoothPart& part, double x) {
    ++evaluations_;
    // At a break itself a sign may be 0, beside it never.
    const double inside = std::clamp(x, -1 + kBesideBreak, 1 - kBesideBreak);
    const double t = chebyshev::outer(inside, part.from, part.to);
    const auto known = std::ranges::find(checks_, t, &Place::t);
    const bool is_kept = known != checks_.end();
    const double value = is_kept && known->value ? *known->value : value_.at(t);
    if (is_kept) known->value = value;
    if (!std::isfinite(value) && !part.undefined) part.undefined = t;
    return value;
  }

  RunValue& value_;
  const hybrid::DenseStep& step_;
  double agreement_;
  std::array<Place, check_points.size()> checks_;  ///< those of the whole step
  std::optional<double> noise_;                    ///< computed when it is asked for
  int evaluations_ = 0;
};

/// The roots of a derivative on [low, high], a part of [-1, 1]; `c` is its series there. It is
/// halved until it is monotone, has no root, or its integral changes by less than `noise`.
void add_roots(const numbers::Matrix& c, double low, double high, double noise,
               std::vector<double>& roots) {
  const auto excludes = [](const numbers::Matrix& matrix) {
    return std::abs(matrix(0)) > matrix.rightCols(matrix.cols() - 1).cwiseAbs().sum();
  };
  if (excludes(c)) return;
  const bool is_noise = c.cwiseAbs().sum() * (high - low) <= noise;
  if (is_noise || excludes(chebyshev::derivative(c))) {
    double left = -1;
    double right = 1;
    const bool first = chebyshev::first(c, left) > 0;
    if (first == (chebyshev::first(c, right) > 0)) return;
    while (right - left > std::numeric_limits<double>::epsilon()) {
      const double middle = (left + right) / 2;
      ((chebyshev::first(c, middle) > 0) == first ? left : right) = middle;
    }
    roots.push_back(chebyshev::outer(left, low, high));
    return;
  }
  const double middle = (low + high) / 2;
  add_roots(chebyshev::part(c, -1, 0), low, middle, noise, roots);
  add_roots(chebyshev::part(c, 0, 1), middle, high, noise, roots);
}

}  // namespace

std::vector<double> turns_of(const SmoothPart& part) {
  std::vector<double> times;
  add_roots(chebyshev::derivative(part.series), -1, 1, part.noise, times);
  for (double& t : times) t = chebyshev::outer(t, part.from, part.to);
  return times;
}

double SmoothPart::time(int point) const {
  return chebyshev::outer(-1 + 2.0 * point / (points() - 1), from, to);
}

double SmoothPart::operator()(double t) const {
  return chebyshev::first(series, chebyshev::inner(t, from, to));
}

std::vector<SmoothPart> smooth_parts(RunValue& value, const hybrid::DenseStep& step,
                                     std::vector<double>* near, double agreement, bool noise) {
  value.follow(step);
  std::vector<SmoothPart> parts;
  Halving halving(value, step, agreement);
  SmoothPart part{step.from, step.to};
  const auto breaks = value.breaks(near);
  if (!breaks) {
    part.undefined = step.from;
    part.followed = false;
    return {part};
  }
  for (const ode::Break& edge : *breaks) {
    part.to = edge.left;
    if (part.from < part.to || parts.empty()) halving.halve(part, kMostEvaluations, parts);
    parts.back().before_jump = edge.jumps;
    part = {edge.right, step.to, edge.jumps};
  }
  if (part.from < part.to || parts.empty()) halving.halve(part, kMostEvaluations, parts);
  if (noise)
    for (SmoothPart& piece : parts)
      if (!piece.undefined) piece.noise += halving.noise();
  return parts;
}

void add_tops(const SmoothPart& part, double from, double to, double sign, std::vector<Top>& tops) {
  std::vector<double> times;
  std::vector<double> values;
  for (int k = 0; k < part.points(); ++k) {
    times.push_back(std::clamp(part.time(k), from, to));
    values.push_back(sign * part(times.back()));
  }
  for (std::size_t k = 0; k < times.size(); ++k) {
    const std::size_t before = k == 0 ? k : k - 1;
    const std::size_t after = std::min(k + 1, times.size() - 1);
    if (values[k] < values[before] || values[k] < values[after]) continue;
    tops.push_back({values[k], values[k] - std::min(values[before], values[after]), times[k],
                    times[before], times[after]});
  }
}

}  // namespace gainsmith::claims
