// Internal to numerics: the projections, instantiated by one source an arithmetic.
#pragma once

#include <optional>

#include "numerics/projection_rules.h"

namespace gainsmith::numerics {

namespace projections {

/// The row that z is farthest outside of in the metric; the first of several; none when z is inside
/// to a quarter of its rounding, which leaves room for rounding the result.
template <class W>
std::optional<Eigen::Index> most_violated(const Rows<W>& rows, const Basis<W>& basis,
                                          const Column<W>& z, bool rounded) {
  std::optional<Eigen::Index> worst;
  W farthest(0);
  for (Eigen::Index i = 0; i < rows.count(); ++i) {
    if (basis.has(i)) continue;
    const W excess = rows.excess(i, z);
    if (!(excess > rows.unsure(i, z) * W(rounded ? 1 : 0.25))) continue;
    if (rows.is_zero(i)) throw NoProjection("the polytope is empty");
    const W distance = excess / rows.lengths(i);
    if (worst && !(distance > farthest)) continue;
    worst = i;
    farthest = distance;
  }
  return worst;
}

/// Brings row p, which d violates by `gap` > 0, into the basis: u_p grows, and with it d moves
/// along the rest of n_p; a row whose u falls to 0 meanwhile leaves. A dependent p cannot be
/// moved to: one row must leave, and where no u falls sum_i |r_i| a_i = a_p contradict it (Farkas).
template <class W>
void activate(Eigen::Index p, W gap, const Rows<W>& rows, Basis<W>& basis, Column<W> u) {
  while (true) {
    const auto split = basis.split(p);
    const W least = split.dependent ? rows.noise(p) : W(0);
    Eigen::Index leaving = -1;
    W longest(0);
    for (Eigen::Index i = 0; i < basis.size(); ++i) {
      if (!(split.r(i) > least)) continue;
      const W reach = std::max(u(i), W(0)) / split.r(i);
      if (leaving >= 0 && !(reach < longest)) continue;
      leaving = i;
      longest = reach;
    }
    if (split.dependent && leaving < 0) throw NoProjection("the polytope is empty");
    if (!split.dependent && (leaving < 0 || gap <= longest * split.square)) return basis.add(p);
    if (!split.dependent) gap -= longest * split.square;
    Column<W> left(u.size() - 1);
    for (Eigen::Index i = 0, to = 0; i < u.size(); ++i)
      if (i != leaving) left(to++) = u(i) - longest * split.r(i);
    u = left;
    basis.remove(leaving);
  }
}

/// The point of the rows nearest to x, z = x + T'd, with a multiplier y for each row.
template <class W>
struct Nearest {
  Column<W> z;
  Column<W> y;
  bool moved = false;  ///< z is not x
};

template <class W>
Nearest<W> nearest_of_rows(const Column<W>& x, const MatrixOf<W>& T, const Rows<W>& rows) {
  Basis<W> basis(rows);
  Nearest<W> found{x, Column<W>::Zero(rows.count())};
  Column<W> u(0);
  auto p = most_violated<W>(rows, basis, x, true);
  found.moved = p.has_value();
  for (W covered(0); p; p = most_violated<W>(rows, basis, found.z, false)) {
    activate<W>(*p, rows.excess(*p, found.z) / rows.lengths(*p), rows, basis, u);
    const auto step = basis.shortest(x);
    found.z = on_rows<W>(x, step.d, T, rows, basis);
    u = step.u;
    // What is left to gain is below the working arithmetic.
    if (!(step.d.squaredNorm() > covered)) break;
    covered = step.d.squaredNorm();
  }
  for (Eigen::Index i = 0; i < basis.size(); ++i)
    found.y(basis.row(i)) = std::max(u(i), W(0)) / rows.lengths(basis.row(i));
  return found;
}

/// Eigenvalues q and orthonormal columns V with M = V diag(q) V', by Jacobi's rotations (Golub and
/// Van Loan, 8.5.2).
template <class W>
Column<W> symmetric_eigenvalues(MatrixOf<W> M, MatrixOf<W>& V) {
  using std::sqrt;
  constexpr int kMostSweeps = 60;
  const Eigen::Index n = M.rows();
  const W epsilon = std::numeric_limits<W>::epsilon();
  V = MatrixOf<W>::Identity(n, n);
  bool still = false;
  for (int sweep = 0; sweep < kMostSweeps && !still; ++sweep) {
    still = true;
    for (Eigen::Index p = 0; p < n; ++p)
      for (Eigen::Index q = p + 1; q < n; ++q) {
        const W off = M(p, q);
        if (!(off * off > epsilon * epsilon * size_of<W>(M(p, p) * M(q, q)))) continue;
        still = false;
        const W zeta = (M(q, q) - M(p, p)) / (W(2) * off);
        const W t = (zeta < W(0) ? W(-1) : W(1)) / (size_of<W>(zeta) + sqrt(W(1) + zeta * zeta));
        const W cosine = W(1) / sqrt(W(1) + t * t), sine = cosine * t;
        const auto rotate = [&](auto&& x, auto&& y) {
          const Column<W> old = x;
          x = cosine * x - sine * y;
          y = sine * old + cosine * y;
        };
        rotate(M.col(p), M.col(q));
        rotate(M.row(p).transpose(), M.row(q).transpose());
        M(p, q) = M(q, p) = W(0);
        rotate(V.col(p), V.col(q));
      }
  }
  return M.diagonal();
}

/// The axes that the metric and a form share: with d = V'L'(z - x0) the metric is d'd and the form
/// d' diag(q) d.
template <class W>
struct Axes {
  Column<W> q;
  MatrixOf<W> forth;  ///< V'L'
  MatrixOf<W> back;   ///< T'V
};

template <class W>
Axes<W> common_axes(const MatrixOf<W>& T, const MatrixOf<W>& form, const W& rounding) {
  const MatrixOf<W> turned = T.transpose();
  MatrixOf<W> V;
  Axes<W> axes{symmetric_eigenvalues<W>(times<W>(times<W>(T, form), turned), V), V.transpose(),
               times<W>(turned, V)};
  const W noise =
      rounding *
      times<W>(times<W>(sizes<W>(T), sizes<W>(form)), MatrixOf<W>(sizes<W>(turned))).trace();
  for (W& value : axes.q) {
    if (value < -noise) throw NoProjection("Q is not positive semidefinite");
    value = std::max(value, W(0));
  }
  // V'L' column by column, by substitution: V' = (V'L') T'.
  for (Eigen::Index j = 0; j < T.cols(); ++j) {
    for (Eigen::Index k = 0; k < j; ++k) axes.forth.col(j) -= axes.forth.col(k) * T(j, k);
    axes.forth.col(j) /= T(j, j);
  }
  return axes;
}

/// from' Q from <= r to the rounding of z = x0 + from.
template <class W>
bool is_below(const MatrixOf<W>& form, const Column<W>& from, const Column<W>& z, const W& level,
              const W& rounding) {
  const Column<W> reach = W(2) * sizes<W>(from) + rounding * sizes<W>(z);
  const Column<W> weight = times<W>(sizes<W>(form), sizes<W>(z));
  const Column<W> slope = times<W>(form, from);
  return from.dot(slope) <= level + rounding * (reach.dot(weight) + level);
}

/// The y > 0 with f(y) = sum_i q_i c_i^2 / (1 + y q_i)^2 = r, where f(0) > r > 0.
template <class W>
W secular_root(const Column<W>& q, const Column<W>& c, const W& r) {
  using std::sqrt;
  constexpr int kMostSteps = 2000;  // bisections of the whole range of a double's exponents
  // q / (1 + y q)^2 <= 1 / (4 y).
  W low(0), high = c.squaredNorm() / (W(4) * r);
  W y(0);
  for (int step = 0; step < kMostSteps; ++step) {
    W value(0), slope(0);
    for (Eigen::Index i = 0; i < q.size(); ++i) {
      const W by = W(1) / (W(1) + y * q(i));
      const W term = q(i) * c(i) * c(i) * by * by;
      value += term;
      slope -= W(2) * q(i) * term * by;
    }
    (value > r ? low : high) = y;
    // On 1 / sqrt(f) - 1 / sqrt(r).
    W next = y + W(2) * value * (sqrt(value / r) - W(1)) / -slope;
    if (!(next > low && next < high)) next = low + (high - low) * W(0.5);
    const bool settled =
        size_of<W>(next - y) <= W(4) * std::numeric_limits<W>::epsilon() * size_of<W>(next);
    y = next;
    if (settled || !(low < high)) break;
  }
  return y;
}

}  // namespace projections

template <class S>
Projection<S> project_polytope(const MatrixOf<S>& x, const MatrixOf<S>& P, const MatrixOf<S>& A,
                               const MatrixOf<S>& b) {
  using namespace projections;
  using W = Working<S>;
  const MatrixOf<W> T = metric<W>(widened<S>(P), rounding<S>());
  const Rows<W> rows(widened<S>(A), widened<S>(b), T, rounding<S>());
  const Nearest<W> found = nearest_of_rows<W>(widened<S>(x), T, rows);
  if (!found.moved) return unmoved<S>(x, A.rows());
  return {narrowed<S>(found.z), narrowed<S>(found.y)};
}

template <class S>
Projection<S> project_ellipsoid(const MatrixOf<S>& x, const MatrixOf<S>& P, const MatrixOf<S>& x0,
                                const MatrixOf<S>& Q, const MatrixOf<S>& r) {
  using namespace projections;
  using W = Working<S>;
  const W unit = rounding<S>(), level = as<W>(r(0, 0));
  const MatrixOf<W> T = metric<W>(widened<S>(P), unit);
  const MatrixOf<W> form = symmetric_part<W>(widened<S>(Q));
  const Axes<W> axes = common_axes<W>(T, form, unit);
  if (level < W(0)) throw NoProjection("the ellipsoid is empty: r is negative");
  const Column<W> point = widened<S>(x), centre = widened<S>(x0), from = point - centre;
  if (is_below<W>(form, from, point, level, unit)) return unmoved<S>(x, 1);

  const Column<W> c = times<W>(axes.forth, from);
  const W y = level > W(0) ? secular_root<W>(axes.q, c, level) : W(0);
  Column<W> shift = c;
  for (Eigen::Index i = 0; i < c.size(); ++i) {
    if (level > W(0)) shift(i) *= y * axes.q(i) / (W(1) + y * axes.q(i));
    if (!(axes.q(i) > W(0))) shift(i) = W(0);
  }
  const Column<W> most = sizes<W>(from) + times<W>(sizes<W>(axes.back), sizes<W>(shift));
  const Column<W> offset = without_noise<W>(from - times<W>(axes.back, shift), most);
  return {narrowed<S>(Column<W>(centre + offset)), MatrixOf<S>::Constant(1, 1, as<S>(y))};
}

template <class S>
Projection<S> project_affine(const MatrixOf<S>& x, const MatrixOf<S>& P, const MatrixOf<S>& A,
                             const MatrixOf<S>& b) {
  using namespace projections;
  using W = Working<S>;
  const MatrixOf<W> T = metric<W>(widened<S>(P), rounding<S>());
  const Rows<W> rows(widened<S>(A), widened<S>(b), T, rounding<S>());
  const Column<W> start = widened<S>(x);
  bool inside = true;
  for (Eigen::Index i = 0; i < rows.count(); ++i)
    inside = inside && size_of<W>(rows.excess(i, start)) <= rows.unsure(i, start);
  if (inside) return unmoved<S>(x, A.rows());

  Basis<W> basis(rows);
  while (true) {
    std::optional<Eigen::Index> next;
    W most(0);
    for (Eigen::Index i = 0; i < rows.count(); ++i) {
      if (rows.is_zero(i) || basis.has(i)) continue;
      const auto split = basis.split(i);
      if (split.dependent || !(split.square > most)) continue;
      next = i;
      most = split.square;
    }
    if (!next) break;
    basis.add(*next);
  }
  const auto step = basis.shortest(start);
  const Column<W> z = on_rows<W>(start, step.d, T, rows, basis);
  const W several(static_cast<double>(x.rows() + 4));  // roundings in the making of a row
  for (Eigen::Index i = 0; i < rows.count(); ++i) {
    if (basis.has(i)) continue;
    W unsure = rows.unsure(i, z);
    if (!rows.is_zero(i)) {
      const Column<W> r = basis.split(i).r;
      for (Eigen::Index k = 0; k < basis.size(); ++k)
        unsure += size_of<W>(r(k)) * rows.lengths(i) / rows.lengths(basis.row(k)) *
                  rows.unsure(basis.row(k), z);
      unsure *= several;
    }
    if (size_of<W>(rows.excess(i, z)) > unsure) throw NoProjection("the affine set is empty");
  }
  return moved<S>(z, rows, basis, step.u);
}

}  // namespace gainsmith::numerics
