// Internal to numerics: what the projections share, over the arithmetic W that they work in.
//
//   metric   P = L L', T = L^-1     z = x + T'd,  |d|^2 = (z - x)' P (z - x)
//   row      a'(z - x) = (T a)'d    n = T a / |T a|
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "numerics/projection.h"
#include "numerics/working.h"

namespace gainsmith::numerics::projections {

template <class W>
using Column = Eigen::Matrix<W, Eigen::Dynamic, 1>;

template <class W>
W size_of(const W& x) {
  return x < W(0) ? -x : x;
}
template <class W>
MatrixOf<W> sizes(const MatrixOf<W>& M) {
  return M.unaryExpr([](const W& x) { return size_of<W>(x); });
}

template <class W>
W length(const Column<W>& v) {
  using std::sqrt;
  return sqrt(v.squaredNorm());
}

/// T of the metric, lower triangular. A pivot that is nothing but the rounding of the diagonal of P
/// shows that P is singular, in any units.
template <class W>
MatrixOf<W> metric(const MatrixOf<W>& P, const W& rounding) {
  using std::sqrt;
  const Eigen::Index n = P.rows();
  MatrixOf<W> L = symmetric_part<W>(P);
  for (Eigen::Index j = 0; j < n; ++j) {
    const W pivot = L(j, j) - L.row(j).head(j).squaredNorm();
    if (!(L(j, j) > W(0) && pivot > rounding * L(j, j)))
      throw NoProjection("P is not positive definite");
    L(j, j) = sqrt(pivot);
    for (Eigen::Index i = j + 1; i < n; ++i)
      L(i, j) = (L(i, j) - L.row(i).head(j).dot(L.row(j).head(j))) / L(j, j);
  }
  MatrixOf<W> T = MatrixOf<W>::Zero(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    T(j, j) = W(1) / L(j, j);
    for (Eigen::Index i = j + 1; i < n; ++i)
      T(i, j) = -L.row(i).segment(j, i - j).dot(T.col(j).segment(j, i - j)) / L(i, i);
  }
  return T;
}

/// The rows a_i of A in the metric.
template <class W>
struct Rows {
  MatrixOf<W> A;
  Column<W> b;
  MatrixOf<W> normals;  ///< n x m, unit columns n_i, or 0
  Column<W> lengths;    ///< |T a_i|
  Column<W> noise;      ///< how far the rounding of a_i may turn n_i
  W rounding;

  Rows(const MatrixOf<W>& rows, const Column<W>& right, const MatrixOf<W>& T, const W& unit)
      : A(rows), b(right), normals(times<W>(T, rows.transpose())), rounding(unit) {
    const MatrixOf<W> most = times<W>(sizes<W>(T), sizes<W>(rows.transpose()));
    lengths = Column<W>::Zero(rows.rows());
    noise = lengths;
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
      lengths(i) = length<W>(normals.col(i));
      if (is_zero(i)) continue;
      normals.col(i) /= lengths(i);
      noise(i) = rounding * length<W>(most.col(i)) / lengths(i);
    }
  }

  Eigen::Index count() const { return A.rows(); }
  bool is_zero(Eigen::Index i) const { return !(lengths(i) > W(0)); }
  /// a_i'z - b_i.
  W excess(Eigen::Index i, const Column<W>& z) const { return A.row(i).dot(z.transpose()) - b(i); }
  /// What the rounding of z changes it by: epsilon (|a_i|'|z| + |b_i|).
  W unsure(Eigen::Index i, const Column<W>& z) const {
    W sum = size_of<W>(b(i));
    for (Eigen::Index j = 0; j < z.size(); ++j) sum += size_of<W>(A(i, j) * z(j));
    return rounding * sum;
  }
};

/// Linearly independent normals N = [n_i, ...] = Q R with orthonormal Q and triangular R.
template <class W>
class Basis {
 public:
  explicit Basis(const Rows<W>& rows)
      : rows_(rows), Q_(rows.A.cols(), rows.A.cols()), R_(rows.A.cols(), rows.A.cols()) {}

  Eigen::Index size() const { return static_cast<Eigen::Index>(members_.size()); }
  Eigen::Index row(Eigen::Index position) const {
    return members_[static_cast<std::size_t>(position)];
  }
  bool has(Eigen::Index row) const {
    return std::find(members_.begin(), members_.end(), row) != members_.end();
  }

  /// n_row = N r + rest, with rest orthogonal to N.
  struct Split {
    Column<W> r;
    Column<W> rest;
    W square;        ///< |rest|^2
    bool dependent;  ///< |rest| is within the rounding of the rows
  };
  Split split(Eigen::Index row) const {
    const Eigen::Index k = size();
    Split result{{}, rows_.normals.col(row), {}, false};
    const Column<W> h = orthogonalise(result.rest);
    result.r = upper_solve(h);
    result.square = result.rest.squaredNorm();
    W noise = rows_.noise(row);
    for (Eigen::Index i = 0; i < k; ++i)
      noise += size_of<W>(result.r(i)) * rows_.noise(this->row(i));
    result.dependent = k == Q_.rows() || !(result.square > noise * noise);
    return result;
  }

  /// A row that is not dependent.
  void add(Eigen::Index row) {
    const Eigen::Index k = size();
    Column<W> rest = rows_.normals.col(row);
    R_.col(k).head(k) = orthogonalise(rest);
    R_(k, k) = length<W>(rest);
    Q_.col(k) = rest / R_(k, k);
    members_.push_back(row);
  }
  void remove(Eigen::Index position) {
    std::vector<Eigen::Index> rest(members_.begin() + position + 1, members_.end());
    members_.resize(static_cast<std::size_t>(position));
    for (const Eigen::Index row : rest) add(row);
  }

  /// The shortest d with n_i'd = -excess_i(x) / |T a_i| for all rows i of the basis, and u with
  /// d = -N u.
  struct Step {
    Column<W> d;
    Column<W> u;
  };
  Step shortest(const Column<W>& x) const {
    const Eigen::Index k = size();
    Column<W> y(k);
    for (Eigen::Index i = 0; i < k; ++i) {
      y(i) = -rows_.excess(row(i), x) / rows_.lengths(row(i)) - R_.col(i).head(i).dot(y.head(i));
      y(i) /= R_(i, i);
    }
    return {times<W>(Q_.leftCols(k), y), -upper_solve(y)};
  }

 private:
  /// Takes what lies along Q out of v, twice for the digits that the first time loses, and returns
  /// it.
  Column<W> orthogonalise(Column<W>& v) const {
    Column<W> h = Column<W>::Zero(size());
    for (int twice = 0; twice < 2; ++twice)
      for (Eigen::Index i = 0; i < size(); ++i) {
        const W along = Q_.col(i).dot(v);
        v -= along * Q_.col(i);
        h(i) += along;
      }
    return h;
  }
  Column<W> upper_solve(Column<W> h) const {
    for (Eigen::Index i = h.size() - 1; i >= 0; --i) {
      h(i) /= R_(i, i);
      for (Eigen::Index j = 0; j < i; ++j) h(j) -= R_(j, i) * h(i);
    }
    return h;
  }

  const Rows<W>& rows_;
  std::vector<Eigen::Index> members_;
  MatrixOf<W> Q_;  ///< the first size() columns
  MatrixOf<W> R_;
};

/// A sum whose terms have the sizes `most`: elements of which only the rounding of W is left become
/// 0. An excess of 1e-32 has no digit that counts, but is large for the row z_1 <= 0.
template <class W>
Column<W> without_noise(Column<W> sum, const Column<W>& most) {
  const W least = W(0x1p20) * std::numeric_limits<W>::epsilon();
  for (Eigen::Index i = 0; i < sum.size(); ++i)
    if (size_of<W>(sum(i)) <= least * most(i)) sum(i) = W(0);
  return sum;
}

/// x + T'd on the rows of the basis, without noise, to a quarter of the rounding of z, which leaves
/// room for rounding the result.
template <class W>
Column<W> on_rows(const Column<W>& x, const Column<W>& d, const MatrixOf<W>& T, const Rows<W>& rows,
                  const Basis<W>& basis) {
  constexpr int kMostCorrections = 12;  // 30 digits each
  const auto meets = [&](const Column<W>& z) {
    for (Eigen::Index k = 0; k < basis.size(); ++k)
      if (size_of<W>(rows.excess(basis.row(k), z)) > rows.unsure(basis.row(k), z) * W(0.25))
        return false;
    return true;
  };
  const MatrixOf<W> turned = T.transpose();
  const Column<W> most = sizes<W>(x) + times<W>(sizes<W>(turned), sizes<W>(d));
  Column<W> z = x + times<W>(turned, d);
  for (int k = 0; k < kMostCorrections; ++k) {
    const Column<W> cleared = without_noise<W>(z, most);
    if (meets(cleared)) return cleared;
    if (meets(z)) break;
    z += times<W>(turned, basis.shortest(z).d);
  }
  return z;
}

/// z of the step d, and the multipliers of the rows of the basis.
template <class S>
Projection<S> moved(const Column<Working<S>>& z, const Rows<Working<S>>& rows,
                    const Basis<Working<S>>& basis, const Column<Working<S>>& u) {
  using W = Working<S>;
  MatrixOf<W> y = MatrixOf<W>::Zero(rows.count(), 1);
  for (Eigen::Index i = 0; i < basis.size(); ++i)
    y(basis.row(i)) = u(i) / rows.lengths(basis.row(i));
  return {narrowed<S>(z), narrowed<S>(y)};
}

template <class S>
Projection<S> unmoved(const MatrixOf<S>& x, Eigen::Index multipliers) {
  return {x, MatrixOf<S>::Constant(multipliers, 1, S(0))};
}

}  // namespace gainsmith::numerics::projections
