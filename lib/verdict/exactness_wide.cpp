// r' H^-1 r < 1 with H in 31 or 100 digits, for multipliers Y_k that double cannot factor.
//
// With the Cholesky factor H = L L' and R = L^-1 (R H R' near I):
//   r' H^-1 r <= |R r|^2 / (1 - |I - R H R'|_inf),
// The norm includes the error bound of H and the rounding. The test asks for |R r|^2 < 0.5 and for
// a norm below 0.01.
#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "base/eigen_scalars.h"
#include "verdict/exactness.h"
#include "verdict/wide_algebra.h"

namespace gainsmith::verdict {

namespace {

using numbers::times;

/// H_ij = sum_k <B_ki, Y_k B_kj Y_k> and a bound of its error: the rounding, and what the B_ki are
/// known to.
template <class S>
struct Gram {
  MatrixOf<S> H;
  numbers::Matrix error;

  explicit Gram(Eigen::Index m) : H(MatrixOf<S>::Zero(m, m)), error(numbers::Matrix::Zero(m, m)) {}

  void add(const ExactBlock<S>& block, const MatrixOf<S>& Y) {
    const Eigen::Index n = Y.rows();
    const double rounding =
        2 * static_cast<double>(n * n + 2 * n + 4) * numbers::unit_roundoff<S>();
    const numbers::Matrix sizes = Y.unaryExpr([](const S& y) { return upper(y); });
    for (std::size_t a = 0; a < block.terms.size(); ++a) {
      const auto& [i, elements] = block.terms[a];
      const auto [moved, largest] = image(elements, Y, sizes);
      for (std::size_t b = a; b < block.terms.size(); ++b) {
        const auto& [j, others] = block.terms[b];
        spend(static_cast<double>(others.size()) * work_of<S>());
        S h(0);
        double missing = 0;
        for (const auto& e : others) {
          h += moved(e.row, e.column) * e.mid;
          // Of B_j, and of Y B_i Y as far as it is known.
          missing += (2 * rounding * upper(e.mid) + e.rad) * largest.first(e.row, e.column) +
                     upper(e.mid) * largest.second(e.row, e.column);
        }
        H(i, j) += h;
        error(i, j) += missing * (1 + 1e-12);
        if (i == j) continue;
        H(j, i) += h;
        error(j, i) += missing * (1 + 1e-12);
      }
    }
  }

 private:
  /// Y B Y; |Y| (|B| + rad) |Y| and |Y| rad |Y|.
  static std::pair<MatrixOf<S>, std::pair<numbers::Matrix, numbers::Matrix>> image(
      const ExactElements<S>& elements, const MatrixOf<S>& Y, const numbers::Matrix& sizes) {
    const Eigen::Index n = Y.rows();
    spend((std::pow(static_cast<double>(n), 3) +
           static_cast<double>(n) * static_cast<double>(elements.size())) *
          work_of<S>());
    MatrixOf<S> BY = MatrixOf<S>::Zero(n, n);
    numbers::Matrix whole = numbers::Matrix::Zero(n, n), rest = whole;
    for (const auto& e : elements) {
      for (Eigen::Index c = 0; c < n; ++c) BY(e.row, c) += e.mid * Y(e.column, c);
      whole.row(e.row) += (upper(e.mid) + e.rad) * sizes.row(e.column);
      rest.row(e.row) += e.rad * sizes.row(e.column);
    }
    return {times<S>(Y, BY), {sizes * whole, sizes * rest}};
  }
};

}  // namespace

template <class S>
bool is_exact_in_wide(const std::vector<WeighedBlock<S>>& blocks, const VectorOf<S>& residuals,
                      const numbers::Vector& residual_error, bool constant) {
  // Seconds of work (base/stop.h).
  constexpr double kMostWork = 0.5;  // what is left open here the other certificates decide
  const auto unknowns = static_cast<double>(residuals.size());
  if (2 * unknowns * unknowns * unknowns * work_of<S>() > kMostWork) return false;
  Gram<S> gram(residuals.size());
  for (const WeighedBlock<S>& block : blocks) gram.add(*block.block, *block.Y);
  std::vector<Eigen::Index> used;
  for (Eigen::Index i = constant ? 0 : 1; i < residuals.size(); ++i)
    if (gram.H(i, i) != S(0) || gram.error(i, i) > 0) used.push_back(i);
  const auto m = static_cast<Eigen::Index>(used.size());
  MatrixOf<S> H = gram.H(used, used);
  VectorOf<S> r = residuals(used);
  numbers::Matrix error = gram.error(used, used);
  if (constant && !used.empty() && used.front() == 0) {
    // y_0 = v makes its own row of the residual 0.
    H(0, 0) += r[0] * r[0];
    r[0] = S(0);
  }
  spend(2 * static_cast<double>(m) * static_cast<double>(m) * static_cast<double>(m) *
        work_of<S>());
  const auto L = cholesky(H);
  if (!L) return false;
  const MatrixOf<S> R = lower_inverse(*L);  // R H R' = I
  const MatrixOf<S> rest = MatrixOf<S>::Identity(m, m) - times<S>(times<S>(R, H), R.transpose());
  // What H is known to, and the rounding of R H R'.
  const numbers::Matrix size_R = R.unaryExpr([](const S& x) { return upper(x); });
  error += 4 * static_cast<double>(m + 2) * numbers::unit_roundoff<S>() *
           H.unaryExpr([](const S& x) { return upper(x); });
  const numbers::Matrix unknown = times<double>(times<double>(size_R, error), size_R.transpose());
  double defect = 0;
  for (Eigen::Index a = 0; a < m; ++a) {
    double sum = unknown.row(a).sum();
    for (Eigen::Index b = 0; b < m; ++b) sum += upper(rest(a, b));
    defect = std::max(defect, sum);
  }
  const VectorOf<S> e = R.lazyProduct(r);
  double norm = 0;
  for (Eigen::Index a = 0; a < m; ++a) {
    double size = upper(e[a]);
    for (Eigen::Index b = 0; b <= a; ++b)
      size += upper(R(a, b)) * residual_error[used[static_cast<std::size_t>(b)]];
    norm += size * size;
  }
  // The rounding of these lines is far below the half that is left.
  return defect < 0.01 && norm * (1 + 1e-9) < 0.5;
}

template bool is_exact_in_wide(const std::vector<WeighedBlock<DoubleDouble>>&,
                               const VectorOf<DoubleDouble>&, const numbers::Vector&, bool);
template bool is_exact_in_wide(const std::vector<WeighedBlock<Decimal100>>&,
                               const VectorOf<Decimal100>&, const numbers::Vector&, bool);

}  // namespace gainsmith::verdict
