// Over all scalars: double is computed in 31 digits, both others in Decimal100.
#include "numerics/convex_projection.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "numerics/projection_sets.h"

namespace gainsmith::numerics {

namespace projections {

using Eigen::Index;

/// A point with what the functions are there; `slope` by the elements of z alone.
template <class W>
struct Place {
  Column<W> z;
  Column<W> value;
  MatrixOf<W> slope;

  /// b of the tangents slope z <= b.
  Column<W> right() const { return times<W>(slope, z) - value; }
};

template <class W>
double third_of_digits() {
  return std::cbrt(static_cast<double>(std::numeric_limits<W>::epsilon()));
}

/// The sizes of the elements of z: how far they are from 0, z or x; where that is nothing but
/// rounding, how far z may be from x at its distance from it in the metric.
template <class W>
Column<W> sizes_at(const Column<W>& z, const Column<W>& x, const MatrixOf<W>& P,
                   const MatrixOf<W>& T, const W& rounding) {
  using std::sqrt;
  const Column<W> from = z - x;
  const W distance = sqrt(std::max(from.dot(times<W>(P, from).col(0)), W(0)));
  Column<W> result(z.size());
  for (Index j = 0; j < z.size(); ++j) {
    result(j) = std::max(size_of<W>(z(j)), size_of<W>(x(j)));
    const W reach = distance * length<W>(T.col(j));
    if (result(j) <= rounding * reach) result(j) = reach;
  }
  return result;
}

/// By function with y > 0, the derivatives of its gradient at z, n x (n + q), by central
/// differences; empty for the others.
template <class W>
std::vector<MatrixOf<W>> curvatures(const Functions<W>& c, const Column<W>& z, const Column<W>& y,
                                    const Column<W>& sizes) {
  const W part(third_of_digits<W>());
  std::vector<MatrixOf<W>> result(static_cast<std::size_t>(y.size()));
  for (Index j = 0; j < z.size(); ++j) {
    Column<W> above = z, below = z;
    above(j) += part * sizes(j);
    below(j) -= part * sizes(j);
    const MatrixOf<W> difference = c(above).slope - c(below).slope;
    for (Index i = 0; i < y.size(); ++i) {
      if (!(y(i) > W(0))) continue;
      MatrixOf<W>& of = result[static_cast<std::size_t>(i)];
      if (of.size() == 0) of = MatrixOf<W>::Zero(z.size(), difference.cols());
      of.row(j) = difference.row(i) / (above(j) - below(j));
    }
  }
  return result;
}

/// P + sum_i y_i c_i''.
template <class W>
MatrixOf<W> curved_metric(const MatrixOf<W>& P, const Column<W>& y,
                          const std::vector<MatrixOf<W>>& curvature) {
  MatrixOf<W> H = P;
  for (Index i = 0; i < y.size(); ++i)
    if (y(i) > W(0))
      H += y(i) * symmetric_part<W>(curvature[static_cast<std::size_t>(i)].leftCols(P.cols()));
  return H;
}

/// The rounding that the working arithmetic leaves in what is computed by some sums.
template <class W>
W fine_rounding() {
  return W(0x1p10) * std::numeric_limits<W>::epsilon();
}

template <class W>
class ConvexSearch {
 public:
  ConvexSearch(const Column<W>& x, const MatrixOf<W>& P, const Functions<W>& c, const W& rounding)
      : x_(x), P_(P), T_(metric<W>(P, rounding)), c_(c), rounding_(rounding) {}

  Nearest<W> run() const {
    Lowest at{place(x_), {}, W(0), W(0)};
    at.y = Column<W>::Zero(at.place.value.size());
    if (is_inside(at.place)) return {x_, at.y, false};
    W last(-1);
    for (int step = 0; step < kMostSteps; ++step) {
      const Nearest<W> foot = nearest(x_, T_, at.place);
      const W rest = distance(foot.z, at.place.z);
      const bool falls = last < W(0) || W(2) * rest <= last;
      if (is_close(foot.z, at.place.z, W(falls ? 0x1p-20 : 1))) return {at.place.z, foot.y, true};
      last = rest;
      const Lowest next = higher(at);
      require_above(at.place, next.place);
      at = next;
    }
    throw_unfound();
  }

 private:
  static constexpr int kMostSteps = 500;
  static constexpr int kMostHalvings = 60;
  /// Part of the predicted gain that a step must bring (Armijo).
  static constexpr double kGain = 1e-4;
  /// Where the lowest point is found, against its distance from x.
  static constexpr double kLowest = 1e-6;
  /// What rounding of the data in double may bend a function that is convex by.
  static constexpr double kConvex = 0x1p-34;

  /// The point where the Lagrangian L(z, y) is lowest, nearly.
  struct Lowest {
    Place<W> place;
    Column<W> y;
    W value;  ///< L(z, y)
    W above;  ///< at most how far that is above the lowest value
  };

  [[noreturn]] static void throw_unfound() {
    throw NoProjection(
        "no nearest point is found: each element of c must be convex, with a derivative, and all "
        "must be below 0 somewhere");
  }

  Place<W> place(const Column<W>& z) const {
    const Tangents<W> found = c_(z);
    return {z, found.value, found.slope.leftCols(z.size())};
  }

  /// None where c has no value.
  std::optional<Place<W>> place_if_any(const Column<W>& z) const {
    try {
      return place(z);
    } catch (const NoProjection&) {
      return std::nullopt;
    }
  }

  W distance(const Column<W>& a, const Column<W>& b) const {
    using std::sqrt;
    const Column<W> from = a - b;
    return sqrt(std::max(from.dot(times<W>(P_, from).col(0)), W(0)));
  }

  bool is_inside(const Place<W>& at) const {
    if ((at.value.array() <= W(0)).all()) return true;
    const Rows<W> rows(at.slope, at.right(), T_, rounding_);
    for (Index i = 0; i < rows.count(); ++i)
      if (rows.excess(i, at.z) > rows.unsure(i, at.z)) return false;
    return true;
  }

  /// To a part of the rounding of z, and to what the working arithmetic leaves.
  bool is_close(const Column<W>& w, const Column<W>& z, const W& part) const {
    const Column<W> sizes = sizes_at<W>(z, x_, P_, T_, rounding_);
    const W reach = distance(z, x_);
    for (Index j = 0; j < z.size(); ++j) {
      const W left = fine_rounding<W>() * (sizes(j) + reach * length<W>(T_.col(j)));
      if (!(size_of<W>(w(j) - z(j)) <= part * rounding_ * sizes(j) + left)) return false;
    }
    return true;
  }

  /// On the tangents at a point.
  Nearest<W> nearest(const Column<W>& from, const MatrixOf<W>& T, const Place<W>& at) const {
    try {
      return nearest_of_rows<W>(from, T, Rows<W>(at.slope, at.right(), T, rounding_));
    } catch (const NoProjection&) {
      throw NoProjection("the set is empty, or c is not convex");
    }
  }

  W lagrangian(const Place<W>& at, const Column<W>& y) const {
    const W far = distance(at.z, x_);
    return far * far * W(0.5) + y.dot(at.value);
  }
  Column<W> gradient(const Place<W>& at, const Column<W>& y) const {
    return times<W>(P_, Column<W>(at.z - x_)) + times<W>(at.slope.transpose(), y);
  }
  /// T of the Hessian of L by z.
  MatrixOf<W> hessian(const Place<W>& at, const Column<W>& y) const {
    const Column<W> sizes = sizes_at<W>(at.z, x_, P_, T_, rounding_);
    const auto curvature = curvatures<W>(c_, at.z, y, sizes);
    for (Index i = 0; i < y.size(); ++i)
      if (y(i) > W(0)) require_convex(i, at, curvature[static_cast<std::size_t>(i)], sizes);
    try {
      return metric<W>(curved_metric<W>(P_, y, curvature), fine_rounding<W>());
    } catch (const NoProjection&) {
      throw_unfound();
    }
  }
  /// What rounding leaves of the sum L.
  W noise(const Place<W>& at, const Column<W>& y) const {
    const W far = distance(at.z, x_);
    W sum = far * far;
    for (Index i = 0; i < y.size(); ++i) sum += y(i) * size_of<W>(at.value(i));
    return fine_rounding<W>() * sum;
  }

  /// min over z of L(z, y), by Newton's method with steps that are halved until L falls.
  Lowest lowest(const Column<W>& y, Place<W> at) const {
    for (int step = 0; step < kMostSteps; ++step) {
      const Column<W> slope = gradient(at, y);
      const W rest = length<W>(times<W>(T_, slope));
      const W value = lagrangian(at, y);
      // The curvature of L is at least P.
      if (rest <= W(kLowest) * distance(at.z, x_)) return {at, y, value, rest * rest * W(0.5)};
      const MatrixOf<W> T = hessian(at, y);
      const Column<W> down = -times<W>(T.transpose(), times<W>(T, slope));
      W part(1);
      std::optional<Place<W>> next = place_if_any(at.z + down);
      for (int halving = 0; halving < kMostHalvings; ++halving) {
        const W least = value + W(kGain) * part * slope.dot(down);
        if (next && lagrangian(*next, y) <= least + noise(at, y)) break;
        part *= W(0.5);
        next = place_if_any(at.z + part * down);
      }
      if (!next) throw_unfound();
      require_above(at, *next);
      at = *next;
    }
    throw_unfound();
  }

  /// A step of sequential quadratic programming, which is one of Newton's for the largest
  /// min over z of L(z, y) over y >= 0, halved until that grows.
  Lowest higher(const Lowest& at) const {
    const MatrixOf<W> T = hessian(at.place, at.y);
    const Column<W> force = times<W>(P_, Column<W>(at.place.z - x_));
    const Column<W> from = at.place.z - times<W>(T.transpose(), times<W>(T, force)).col(0);
    const Nearest<W> aim = nearest(from, T, at.place);
    const Column<W> turn = aim.y - at.y, way = aim.z - at.place.z;
    W part(1);
    for (int halving = 0; halving < kMostHalvings; ++halving) {
      const Lowest next =
          lowest(at.y + part * turn, place_if_any(at.place.z + part * way).value_or(at.place));
      const W least = at.value - at.above + W(kGain) * part * turn.dot(at.place.value);
      if (next.value >= least - noise(next.place, next.y)) return next;
      part *= W(0.5);
    }
    throw_unfound();
  }

  /// No curvature below 0 but for what differences leave, against how the slope changes by it.
  static void require_convex(Index i, const Place<W>& at, const MatrixOf<W>& curvature,
                             const Column<W>& sizes) {
    const MatrixOf<W> D = sizes.asDiagonal();
    // By z alone: behind it are the columns of parameters.
    const Index n = sizes.size();
    const MatrixOf<W> bent = times<W>(times<W>(D, curvature.leftCols(n)), D);
    MatrixOf<W> V;
    const W least = symmetric_eigenvalues<W>(symmetric_part<W>(bent), V).minCoeff();
    const W size = projections::sizes<W>(bent).maxCoeff() +
                   projections::sizes<W>(times<W>(at.slope.row(i).head(n), D)).maxCoeff();
    // Where the curvature jumps, at a where or the square of a max, differences are not symmetric.
    const W skew = projections::sizes<W>(bent - bent.transpose()).maxCoeff();
    if (least < -W(kConvex) * size - skew)
      throw NoProjection("c(" + std::to_string(i + 1) +
                         ") is not convex: its curvature is negative");
  }

  /// The tangents at one point lie below the functions at another.
  void require_above(const Place<W>& from, const Place<W>& at) const {
    const Rows<W> rows(from.slope, from.right(), T_, rounding_);
    for (Index i = 0; i < rows.count(); ++i) {
      const W most = rows.unsure(i, at.z) / rounding_ + size_of<W>(at.value(i));
      if (rows.excess(i, at.z) - at.value(i) > W(kConvex) * most)
        throw NoProjection("c(" + std::to_string(i + 1) +
                           ") is not convex: its tangent at one point lies above it at another");
    }
  }

  const Column<W>& x_;
  const MatrixOf<W>& P_;
  const MatrixOf<W> T_;
  const Functions<W>& c_;
  const W rounding_;
};

}  // namespace projections

template <class S>
Projection<S> project_convex(const MatrixOf<S>& x, const MatrixOf<S>& P,
                             const Functions<Working<S>>& c) {
  using namespace projections;
  using W = Working<S>;
  const Column<W> start = widened<S>(x);
  const MatrixOf<W> form = symmetric_part<W>(widened<S>(P));
  const Nearest<W> found = ConvexSearch<W>(start, form, c, rounding<S>()).run();
  if (!found.moved) return unmoved<S>(x, found.y.size());
  return {narrowed<S>(found.z), narrowed<S>(found.y)};
}

template <class S>
MatrixOf<Working<S>> slope_of_projection(const Projection<S>& found, const MatrixOf<S>& x,
                                         const MatrixOf<S>& P, const MatrixOf<Working<S>>& dx,
                                         const MatrixOf<Working<S>>& dP,
                                         const Functions<Working<S>>& c) {
  using namespace projections;
  using W = Working<S>;
  const Column<W> y = widened<S>(found.multipliers);
  std::vector<Index> active;
  for (Index i = 0; i < y.size(); ++i)
    if (y(i) > W(0)) active.push_back(i);
  if (active.empty()) return dx;

  const Index n = x.rows(), q = dx.cols();
  const MatrixOf<W> form = symmetric_part<W>(widened<S>(P));
  const Column<W> z = widened<S>(found.point), from = z - widened<S>(x).col(0);
  const Column<W> sizes =
      sizes_at<W>(z, widened<S>(x), form, metric<W>(form, rounding<S>()), rounding<S>());
  const auto curvature = curvatures<W>(c, z, y, sizes);
  MatrixOf<W> force = times<W>(form, dx);
  for (Index d = 0; d < q; ++d)
    force.col(d) -= times<W>(symmetric_part<W>(dP.col(d).reshaped(n, n)), from);
  for (const Index i : active) force -= y(i) * curvature[static_cast<std::size_t>(i)].rightCols(q);

  // dz = T'(T force - N m), N = T c_A', with the m for which c_A dz + dc_A = 0.
  const MatrixOf<W> slope = c(z).slope(active, Eigen::all);
  const MatrixOf<W> T = metric<W>(curved_metric<W>(form, y, curvature), fine_rounding<W>());
  const MatrixOf<W> N = times<W>(T, slope.leftCols(n).transpose());
  const MatrixOf<W> free = times<W>(T, force);
  const MatrixOf<W> R = metric<W>(times<W>(N.transpose(), N), fine_rounding<W>());
  const MatrixOf<W> m =
      times<W>(R.transpose(), times<W>(R, times<W>(N.transpose(), free) + slope.rightCols(q)));
  return times<W>(T.transpose(), free - times<W>(N, m));
}

#define GAINSMITH_PROJECTIONS(S)                                                                 \
  template Projection<S> project_convex(const MatrixOf<S>&, const MatrixOf<S>&,                  \
                                        const Functions<Working<S>>&);                           \
  template MatrixOf<Working<S>> slope_of_projection(                                             \
      const Projection<S>&, const MatrixOf<S>&, const MatrixOf<S>&, const MatrixOf<Working<S>>&, \
      const MatrixOf<Working<S>>&, const Functions<Working<S>>&);
GAINSMITH_FOR_EACH_SCALAR(GAINSMITH_PROJECTIONS)
#undef GAINSMITH_PROJECTIONS

}  // namespace gainsmith::numerics
