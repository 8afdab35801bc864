#include "verdict/exactness.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "base/eigen_scalars.h"
#include "base/stop.h"
#include "base/unit_roundoff.h"
#include "numbers/dense/dense.h"

namespace gainsmith::verdict {

namespace {

using Eigen::Index;
using numbers::Matrix;
using numbers::Vector;

/// Fills rows `first` ... of G: column i has the lower triangle of L'B_i L, column by column, times
/// sqrt(2) beside the diagonal. The error is in the norm of Frobenius:
///     sum over elements b of (gamma |b| + rad_b) |L_row| |L_column|,  gamma = (2 n + 12) u.
template <class S>
void add_images(const FactoredBlock<S>& block, Index first, Images& images) {
  const Matrix& L = block.L;
  const Index n = L.rows(), rank = L.cols();
  const Vector rows = block.L.rowwise().norm() * (1 + 1e-12);
  // |L'| |B| |L| is the sum of these terms at most, whatever the order of the sums.
  const double rounding = static_cast<double>(2 * n + 12) * kUnitRoundoff;
  const double root = std::sqrt(2.0);
  Matrix BL(n, rank);
  for (const auto& [i, elements] : block.block->terms) {
    spend(static_cast<double>(rank * (n * rank + 2 * static_cast<Index>(elements.size()))) *
          kDoubleWork);
    BL.setConstant(0);
    std::vector<Index> touched;  // rows of B
    double error = 0;
    for (const auto& e : elements) {
      if (std::ranges::find(touched, e.row) == touched.end()) touched.push_back(e.row);
      const double b = as<double>(e.mid);
      BL.row(e.row) += b * L.row(e.column);
      error += (rounding * std::abs(b) + e.rad) * rows[e.row] * rows[e.column];
    }
    const Matrix image = L(touched, Eigen::all).transpose() * BL(touched, Eigen::all);
    Index at = first;
    for (Index c = 0; c < rank; ++c)
      for (Index r = c; r < rank; ++r) images.G(at++, i) = (r == c ? 1 : root) * image(r, c);
    images.error[i] += error * (1 + 1e-12);
  }
}

}  // namespace

template <class S>
Images images_of(const std::vector<FactoredBlock<S>>& blocks, Index unknowns) {
  Index size = 1;
  for (const FactoredBlock<S>& block : blocks) size += block.L.cols() * (block.L.cols() + 1) / 2;
  Images images{Matrix::Zero(size, unknowns), Vector::Zero(unknowns)};
  Index first = 0;
  for (const FactoredBlock<S>& block : blocks) {
    add_images(block, first, images);
    first += block.L.cols() * (block.L.cols() + 1) / 2;
  }
  return images;
}

template Images images_of(const std::vector<FactoredBlock<DoubleDouble>>&, Index);

/// R by Cholesky factors of Q'Q with a shift above its rounding, Q = G R, until Q'Q is near I
/// (Fukaya et al., "Shifted Cholesky QR", 2020).
std::optional<Basis> basis_of(const Images& images, Index first) {
  // |Q'Q - I| in the norm of Frobenius, at which Q is near enough to orthonormal columns.
  constexpr double kNear = 1e-3;
  constexpr int kMostFactors = 5;  // each makes the condition 1e4 times less
  Basis of;
  of.first = first;
  of.lengths = images.G.colwise().norm();
  for (Index i = first; i < images.G.cols(); ++i) {
    if (of.lengths[i] > 0) of.used.push_back(i);
    if (!(of.lengths[i] > 0) && images.error[i] > 0) return std::nullopt;
  }
  const Index m = std::ssize(of.used), size = images.G.rows();
  if (m == 0) return of;
  if (size < m) return std::nullopt;
  const Vector lengths = of.lengths(of.used);
  of.G = images.G(Eigen::all, of.used) * lengths.cwiseInverse().asDiagonal();
  const double rows = static_cast<double>(size), columns = static_cast<double>(m);
  of.roundings = 2 * (rows + columns + 8) * kUnitRoundoff;
  const Matrix I = of.R = Matrix::Identity(m, m);
  Matrix Q = of.G, rest;
  for (int factors = 0;; ++factors) {
    rest = -I;
    rest.selfadjointView<Eigen::Lower>().rankUpdate(Q.transpose());
    rest.triangularView<Eigen::StrictlyUpper>() = rest.transpose();
    if (rest.norm() < kNear || factors == kMostFactors) break;
    const numbers::Cholesky factor(rest + (1 + columns * of.roundings) * I);
    if (!factor || of.roundings * of.R.norm() > 1) return std::nullopt;
    of.R *= factor.lower_solve(I).transpose();
    Q = of.G * of.R.triangularView<Eigen::Upper>();
  }
  // sigma_min(Q)^2 >= 1 - |Q'Q - I|; from its root go the errors of the product G R.
  const double singular = 1 - rest.norm() - of.roundings * Q.squaredNorm();
  const Vector error =
      (images.error(of.used).cwiseQuotient(lengths) * (1 + 1e-12)).array() + 4 * kUnitRoundoff;
  const double moved = error.dot(of.R.rowwise().norm()) +
                       of.roundings * std::sqrt(columns) * of.R.norm() * (1 + 1e-12);
  of.sigma = std::sqrt(std::max(0.0, singular)) * (1 - 1e-12) - moved * (1 + 1e-9);
  // What is not a number is not above it either.
  if (!(of.sigma > 0.1)) return std::nullopt;
  return of;
}

/// theta = (|R'r| + | |R'| error |) / sigma, rounded upward.
std::optional<Move> move_of(const Basis& by, const ResidualsInDouble& residuals) {
  for (Index i = by.first; i < residuals.r.size(); ++i)
    if (!(by.lengths[i] > 0) && (residuals.error[i] > 0 || residuals.r[i] != 0))
      return std::nullopt;
  if (by.used.empty()) return Move{};
  const Vector lengths = by.lengths(by.used);
  const Vector r = residuals.r(by.used).cwiseQuotient(lengths);
  const Vector error = residuals.error(by.used).cwiseQuotient(lengths) * (1 + 1e-12) +
                       (2 * kUnitRoundoff + by.roundings) * r.cwiseAbs();
  const Vector z = by.R.transpose() * r;
  const Vector z_error = by.R.cwiseAbs().transpose() * error * (1 + 1e-9);
  return Move{(z.norm() + z_error.norm()) / by.sigma * (1 + 1e-9), by.R * z};
}

/// With v > 0 the column g_0 has the element v in the last row, and r_0 becomes 0: y_0 = v.
template <class S>
bool is_exact_in_double(const std::vector<FactoredBlock<S>>& blocks,
                        const ResidualsInDouble& residuals, bool constant) {
  Images images = images_of(blocks, residuals.r.size());
  ResidualsInDouble rest = residuals;
  if (constant) {
    // y_0 = v makes its own row of the residual 0.
    images.G(images.G.rows() - 1, 0) = -rest.r[0];
    images.error[0] += rest.error[0];
    rest.r[0] = rest.error[0] = 0;
  }
  const auto m = static_cast<double>(rest.r.size());
  spend(m * m * (static_cast<double>(images.G.rows()) + m / 3) * kBlockWork);
  const auto basis = basis_of(images, constant ? 0 : 1);
  const auto move = basis && !basis->used.empty() ? move_of(*basis, rest) : std::nullopt;
  return move && move->theta < 1;
}

template bool is_exact_in_double(const std::vector<FactoredBlock<DoubleDouble>>&,
                                 const ResidualsInDouble&, bool);
template bool is_exact_in_double(const std::vector<FactoredBlock<Decimal100>>&,
                                 const ResidualsInDouble&, bool);

}  // namespace gainsmith::verdict
