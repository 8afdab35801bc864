#include "verdict/exactness.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <type_traits>

#include "base/eigen_scalars.h"
#include "base/stop.h"
#include "base/unit_roundoff.h"
#include "numbers/dense.h"

namespace gainsmith::verdict {

namespace {

using Eigen::Index;
using numbers::Matrix;
using numbers::Vector;

/// L' B L for each term, its lower triangle with sqrt(2) beside the diagonal.
template <class T, class S>
void add_images(const FactoredBlock<S>& one, Index first, Images& images) {
  const numbers::MatrixOf<T> L = one.L.template cast<T>();
  const Index n = L.rows(), rank = L.cols();
  const Vector rows = one.L.rowwise().norm() * (1 + 1e-12);
  // |L'| |B| |L| is the sum of these terms at most, whatever the order of the sums.
  const double rounding = static_cast<double>(2 * n + 12) * numbers::unit_roundoff<T>();
  const double root = std::sqrt(2.0);
  const double work = std::is_same_v<T, double> ? kDoubleWork : kQuadWork;
  numbers::MatrixOf<T> BL(n, rank);
  for (const auto& [i, elements] : one.block->terms) {
    spend(static_cast<double>(rank * (n * rank + 2 * static_cast<Index>(elements.size()))) * work);
    BL.setConstant(T(0));
    double error = 0;
    for (const auto& e : elements) {
      const T b = as<T>(e.mid);
      BL.row(e.row) += b * L.row(e.column);
      error += (rounding * std::abs(as<double>(e.mid)) + e.rad) * rows[e.row] * rows[e.column];
    }
    numbers::MatrixOf<T> image;
    if constexpr (std::is_same_v<T, double>)
      image = L.transpose() * BL;
    else
      image = numbers::times<T>(L.transpose(), BL);
    Index at = first;
    for (Index c = 0; c < rank; ++c)
      for (Index r = c; r < rank; ++r)
        images.G(at++, i) = (r == c ? 1 : root) * as<double>(image(r, c));
    images.error[i] += error * (1 + 1e-12);
  }
}

}  // namespace

template <class T, class S>
Images images_of(const std::vector<FactoredBlock<S>>& blocks, Index unknowns) {
  Index size = 1;
  for (const FactoredBlock<S>& one : blocks) size += one.L.cols() * (one.L.cols() + 1) / 2;
  Images images{Matrix::Zero(size, unknowns), Vector::Zero(unknowns)};
  Index first = 0;
  for (const FactoredBlock<S>& one : blocks) {
    add_images<T>(one, first, images);
    first += one.L.cols() * (one.L.cols() + 1) / 2;
  }
  if (!std::is_same_v<T, double>)
    images.error += 4 * kUnitRoundoff * images.G.colwise().norm().transpose();
  return images;
}

template Images images_of<double>(const std::vector<FactoredBlock<DoubleDouble>>&, Index);
template Images images_of<DoubleDouble>(const std::vector<FactoredBlock<DoubleDouble>>&, Index);

template <class S>
bool is_exact_in_double(const std::vector<FactoredBlock<S>>& blocks,
                        const ResidualsInDouble& residuals, bool constant) {
  const Index unknowns = residuals.r.size();
  Images images = images_of<double>(blocks, unknowns);
  const Index size = images.G.rows();
  Vector r = residuals.r;
  Vector error = residuals.error;
  if (constant) {
    // y_0 = v makes its own row of the residual 0.
    images.G(size - 1, 0) = -r[0];
    images.error[0] += error[0];
    r[0] = error[0] = 0;
  }
  // The unknowns that occur in a block.
  Index used = 0;
  double norm = 0, moved = 0;
  for (Index i = constant ? 0 : 1; i < unknowns; ++i) {
    const double length = images.G.col(i).norm();
    if (!(length > 0)) {
      if (images.error[i] > 0) return false;
      continue;
    }
    const double missing = (std::abs(r[i]) + error[i]) / length * (1 + 1e-12);
    const double change = images.error[i] / length + 4 * kUnitRoundoff;
    norm += missing * missing;
    moved += change * change;
    images.G.col(used++) = images.G.col(i) / length;
  }
  if (used == 0) return false;
  const auto m = static_cast<double>(used);
  spend(m * m * (static_cast<double>(size) + m / 3) * kBlockWork);
  const auto G = images.G.leftCols(used);
  Matrix H = Matrix::Zero(used, used);
  H.selfadjointView<Eigen::Lower>().rankUpdate(G.transpose());
  // sigma >= 2 |D r|, so that r' H^-1 r <= 1/4.
  if (!std::isfinite(norm) || !std::isfinite(moved)) return false;
  const double sigma = (2 * std::sqrt(norm) + std::sqrt(moved)) * (1 + 1e-9) + 1e-150;
  const double rounding = 4 * (static_cast<double>(size) + m + 8) * kUnitRoundoff * m;
  H.diagonal().array() -= sigma * sigma + rounding;
  H.triangularView<Eigen::StrictlyUpper>() = H.transpose();
  return static_cast<bool>(numbers::Cholesky(H));
}

template bool is_exact_in_double(const std::vector<FactoredBlock<DoubleDouble>>&,
                                 const ResidualsInDouble&, bool);
template bool is_exact_in_double(const std::vector<FactoredBlock<Decimal100>>&,
                                 const ResidualsInDouble&, bool);

}  // namespace gainsmith::verdict
