#include "verdict/boundary_pair.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/eigen_scalars.h"
#include "base/stop.h"
#include "numbers/dense/dense.h"
#include "verdict/wide_algebra.h"

namespace gainsmith::verdict {

namespace {

using Eigen::Index;
using numbers::Matrix;
using numbers::Vector;
using WideBlock = ExactBlock<Decimal100>;

/// The largest |element|, in double.
double largest(const Wide& matrix) {
  double result = 0;
  for (Index e = 0; e < matrix.size(); ++e) result = std::max(result, size_of(matrix(e)));
  return result;
}

/// B(x).
Wide value_of(const WideBlock& block, const std::vector<Decimal100>& x) {
  Wide result = Wide::Zero(block.size, block.size);
  for (const auto& [i, elements] : block.terms) {
    const Decimal100& factor = x[static_cast<std::size_t>(i)];
    if (factor == 0) continue;
    spend(static_cast<double>(elements.size()) * kWideWork);
    for (const auto& e : elements)
      if (e.row <= e.column) result(e.row, e.column) += factor * e.mid;
  }
  for (Index c = 0; c < block.size; ++c)
    for (Index r = 0; r < c; ++r) result(c, r) = result(r, c);
  return result;
}

/// Adds <B_i, Y> to r_i, and |B_i| |Y| to their scale.
void add_residuals(const WideBlock& block, const Wide& Y, std::vector<Decimal100>& r,
                   Vector& scale) {
  const Matrix sizes = Y.unaryExpr([](const Decimal100& y) { return size_of(y); });
  for (const auto& [i, elements] : block.terms) {
    spend(static_cast<double>(elements.size()) * kWideWork);
    Decimal100 sum(0);
    for (const auto& e : elements) {
      if (e.row > e.column) continue;
      const double times = e.row == e.column ? 1 : 2;
      scale[i] += times * size_of(e.mid) * sizes(e.row, e.column);
      const Decimal100 term = e.mid * Y(e.row, e.column);
      sum += e.row == e.column ? term : Decimal100(term + term);
    }
    r[static_cast<std::size_t>(i)] += sum;
  }
}

/// The damping d of (2) beside coefficients near 1, and sizes of relative residuals.
constexpr double kLeastDamping = 1e-9;  // refinement undoes it
constexpr double kPairSettled = 1e-90;
constexpr double kPairEnough = 1e-80;  // where steps lead no further

/// The residuals (1) and how large they are.
struct PairResiduals {
  std::vector<Decimal100> r;
  std::vector<Wide> c;
  double worst_r = 0;  ///< of |r_i| beside its terms
  double worst_c = 0;

  double worst() const { return std::max(worst_r, worst_c); }

  /// What a step that led here left of those before it. Of two kinds that are of different sizes
  /// both count: damped steps reduce one before the other.
  double share_of(const PairResiduals& before) const {
    constexpr double kGrows = 100;
    const double of_r = ratio(worst_r, before.worst_r), of_c = ratio(worst_c, before.worst_c);
    return std::max(of_r, of_c) <= kGrows ? std::sqrt(of_r * of_c) : std::max(of_r, of_c);
  }

 private:
  static double ratio(double now, double before) {
    return std::max(now, kPairSettled) / std::max(before, kPairSettled);
  }
};

/// (1) in 100 digits; r_i is taken beside its terms, but no less than 1e-3 of the unit. Beside a
/// violation r_0 has no equation, and that of s is 1 - tr Y = 0.
PairResiduals pair_residuals(const std::vector<const WideBlock*>& blocks,
                             const BoundaryPair& pair) {
  PairResiduals result;
  result.r.assign(pair.x.size(), Decimal100(0));
  Vector scale = Vector::Zero(static_cast<Index>(pair.x.size()));
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    const Wide B = value_of(*blocks[k], pair.x);
    const Wide& Y = pair.Y[k];
    const auto n = static_cast<double>(Y.rows());
    spend(n * n * n * kWideWork);
    const Wide product = numbers::times<Decimal100>(B, Y);
    result.c.push_back(product + product.transpose());
    result.worst_c = std::max(result.worst_c, largest(result.c.back()));
    add_residuals(*blocks[k], Y, result.r, scale);
  }
  if (pair.violated) {
    result.r.front() = 0;
    result.r.back() += 1;
  }
  for (std::size_t i = 0; i < result.r.size(); ++i)
    if (const double of = scale[static_cast<Index>(i)]; of > 0)
      result.worst_r = std::max(result.worst_r, size_of(result.r[i]) / std::max(of, 1e-3));
  return result;
}

/// The two ranges of one block in double.
struct Ranges {
  Matrix U, V;
  Vector lambda, s;

  Index rank() const { return V.cols(); }
};

/// B = Q diag(b) Q', n x n. Column q_j of Q belongs to V where q_j'Y q_j > 100 |b_j|, and to U
/// where it is below |b_j| / 100; none where it is neither, as strict complementarity then is not
/// seen. V is turned so that V'Y V = diag(s). None too where a lambda or an s is not positive.
std::optional<Ranges> ranges_of(const Matrix& B, const Matrix& Y) {
  constexpr double kApart = 100;
  const Index n = B.rows();
  if (n == 0) return Ranges{B, B, Vector::Zero(0), Vector::Zero(0)};
  const numbers::SymmetricEigen eigen(B);
  const Matrix& Q = eigen.vectors();
  const Matrix seen = Q.transpose() * Y * Q;
  std::vector<Index> kernel, range;
  for (Index j = 0; j < n; ++j) {
    const double b = std::abs(eigen.values()[j]), y = std::abs(seen(j, j));
    if (!(b > kApart * y || y > kApart * b)) return std::nullopt;
    (y > b ? kernel : range).push_back(j);
  }
  Ranges result;
  result.U = Q(Eigen::all, range);
  result.lambda = eigen.values()(range);
  const Matrix V = Q(Eigen::all, kernel);
  if (kernel.empty()) {
    result.V = V;
    result.s = Vector::Zero(0);
  } else {
    const numbers::SymmetricEigen inner(V.transpose() * Y * V);
    result.V = V * inner.vectors();
    result.s = inner.values();
  }
  if ((result.lambda.array() <= 0).any() || (result.s.array() <= 0).any()) return std::nullopt;
  return result;
}

/// B_i as it is in double, times a matrix.
void product_with(const ExactElements<Decimal100>& elements, const Matrix& by, Matrix& out) {
  out.setZero();
  for (const auto& e : elements) out.row(e.row) += as<double>(e.mid) * by.row(e.column);
}

/// One block's part of (2).
struct BoundaryPart {
  Ranges ranges;
  Matrix across;    ///< column i: U'B_i V, (u, v) column by column
  Index first = 0;  ///< of its dS among all
};

/// The saddle point system (2) of all blocks in double, factored once and used for several steps. H
/// is m x m; A has a row for each element of the dS_k, rank (rank + 1)/2 a block.
class System {
 public:
  System(const std::vector<const WideBlock*>& blocks, const BoundaryPair& pair)
      : blocks_(blocks),
        unknowns_(static_cast<Index>(pair.x.size())),
        first_(pair.violated ? 1 : 0) {}

  /// False where the ranges are not told apart.
  bool set_up(const BoundaryPair& pair, double damping) {
    parts_.clear();
    Index size = 0;
    for (std::size_t k = 0; k < blocks_.size(); ++k) {
      const auto ranges =
          ranges_of(narrow<double>(value_of(*blocks_[k], pair.x)), narrow<double>(pair.Y[k]));
      if (!ranges) return false;
      parts_.push_back({*ranges, {}, size});
      size += ranges->rank() * (ranges->rank() + 1) / 2;
    }
    if (size == 0) return false;
    damping_ = damping;
    A_ = Matrix::Zero(size, unknowns_);
    H_ = Matrix::Zero(unknowns_, unknowns_);
    for (std::size_t k = 0; k < blocks_.size(); ++k) add_part(*blocks_[k], parts_[k]);
    return factor(damping);
  }

  /// Adds a step for residuals that were divided by `scale` to the pair.
  void move(const PairResiduals& residuals, BoundaryPair& pair) const {
    const double scale = residuals.worst();
    const auto scaled = [&](const Decimal100& x) { return as<double>(Decimal100(x / scale)); };
    std::vector<Matrix> known;  // of dY, what does not depend on dx and dS
    Vector f(unknowns_), w(A_.rows());
    for (Index i = 0; i < unknowns_; ++i) f[i] = -scaled(residuals.r[static_cast<std::size_t>(i)]);
    for (std::size_t k = 0; k < blocks_.size(); ++k) {
      known.push_back(of_complementarity(parts_[k], residuals.c[k].unaryExpr(scaled), w));
      for (const auto& [i, elements] : blocks_[k]->terms)
        for (const auto& e : elements)
          if (i >= first_) f[i] -= as<double>(e.mid) * known[k](e.row, e.column);
    }
    const auto [dx, dS] = solve(f, w);
    for (Index i = 0; i < unknowns_; ++i)
      pair.x[static_cast<std::size_t>(i)] += Decimal100(dx[i]) * scale;
    for (std::size_t k = 0; k < blocks_.size(); ++k) {
      const Matrix dY = known[k] + of_unknowns(parts_[k], dx, dS);
      for (Index c = 0; c < dY.cols(); ++c)
        for (Index r = 0; r <= c; ++r) {
          pair.Y[k](r, c) += Decimal100((dY(r, c) + dY(c, r)) / 2) * scale;
          pair.Y[k](c, r) = pair.Y[k](r, c);
        }
    }
  }

 private:
  /// Of the elements v <= w of a symmetric matrix, with which <M, N> is a sum over them.
  static double root(Index v, Index w) { return v == w ? 1 : std::sqrt(2.0); }

  /// Adds the block's H_ij = 2 sum_(u,v) (s_v / lambda_u) (U'B_i V)_uv (U'B_j V)_uv and fills its
  /// rows of A with V'B_i V, off-diagonal elements times sqrt(2).
  void add_part(const WideBlock& block, BoundaryPart& part) {
    const auto& [U, V, lambda, s] = part.ranges;
    const Index rank = V.cols();
    if (rank == 0) return;
    part.across = Matrix::Zero(U.cols() * rank, unknowns_);
    Matrix BV(block.size, rank);
    for (const auto& [i, elements] : block.terms) {
      if (i < first_) continue;
      spend(static_cast<double>(
                rank * (Index{block.size} * block.size + static_cast<Index>(elements.size()))) *
            kDoubleWork);
      product_with(elements, V, BV);
      part.across.col(i) = (U.transpose() * BV).reshaped();
      const Matrix inside = V.transpose() * BV;
      Index at = part.first;
      for (Index v = 0; v < rank; ++v)
        for (Index u = 0; u <= v; ++u) A_(at++, i) = root(u, v) * inside(u, v);
    }
    if (U.cols() == 0) return;
    Matrix weighed = part.across;
    for (Index v = 0, at = 0; v < rank; ++v)
      for (Index u = 0; u < U.cols(); ++u) weighed.row(at++) *= std::sqrt(2 * s[v] / lambda[u]);
    const auto m = static_cast<double>(unknowns_);
    spend(m * m * static_cast<double>(weighed.rows()) * kBlockWork);
    H_.selfadjointView<Eigen::Lower>().rankUpdate(weighed.transpose());
  }

  /// Cholesky factors of H + d I and of its Schur complement A (H + d I)^-1 A' + d I; false where
  /// one of them is not positive definite in double.
  bool factor(double damping) {
    H_.triangularView<Eigen::StrictlyUpper>() = H_.transpose();
    const auto m = static_cast<double>(unknowns_), q = static_cast<double>(A_.rows());
    spend((m * m * m / 3 + m * m * q + q * q * m + q * q * q / 3) * kBlockWork);
    Matrix upper = H_;
    upper.diagonal().array() += damping;
    upper_.emplace(upper);
    if (!*upper_) return false;
    const Matrix half = upper_->lower_solve(A_.transpose());
    Matrix lower = Matrix::Zero(A_.rows(), A_.rows());
    lower.selfadjointView<Eigen::Lower>().rankUpdate(half.transpose());
    lower.triangularView<Eigen::StrictlyUpper>() = lower.transpose();
    // It is singular where multipliers have a choice: above its rounding.
    constexpr double kRounding = 1e-15;
    const double rounding = kRounding * q * lower.diagonal().maxCoeff();
    lower.diagonal().array() += std::max(damping, rounding);
    lower_.emplace(lower);
    return static_cast<bool>(*lower_);
  }

  /// dx and dS with (2): dS from the Schur complement, then dx = (H + d I)^-1 (A'dS - f).
  /// Refinement repeats this with the residual of the undamped system while it falls.
  std::pair<Vector, Vector> solve(const Vector& f, const Vector& w) const {
    // At most so many rounds, each of which must halve the residual.
    constexpr int kMost = 12;
    constexpr double kFalls = 0.5;
    Vector dx = Vector::Zero(unknowns_), dS = Vector::Zero(A_.rows());
    Vector first = f, second = w;
    double last = std::numeric_limits<double>::infinity();
    // Of more than the least it is meant to stay: the residuals are consistent up to second order.
    const int most = damping_ > kLeastDamping ? 1 : kMost;
    for (int k = 0; k < most; ++k) {
      const auto m = static_cast<double>(unknowns_), q = static_cast<double>(A_.rows());
      spend((3 * m * m + 4 * m * q + q * q) * kDoubleWork);
      const Vector towards = upper_->solve(Matrix(first));
      const Vector change = lower_->solve(Matrix(second + A_ * towards));
      Vector next_x = dx + upper_->solve(Matrix(A_.transpose() * change - first));
      Vector next_S = dS + change;
      const Vector rest_f = f + H_ * next_x - A_.transpose() * next_S;
      const Vector rest_w = w - A_ * next_x;
      const double rest = std::sqrt(rest_f.squaredNorm() + rest_w.squaredNorm());
      if (!(rest < last)) break;
      dx = std::move(next_x);
      dS = std::move(next_S);
      first = rest_f;
      second = rest_w;
      if (rest > kFalls * last) break;
      last = rest;
    }
    return {dx, dS};
  }

  /// What c alone makes of dY, and w.
  static Matrix of_complementarity(const BoundaryPart& part, const Matrix& c, Vector& w) {
    const auto& [U, V, lambda, s] = part.ranges;
    Matrix uu = U.transpose() * c * U;
    for (Index b = 0; b < uu.cols(); ++b)
      for (Index a = 0; a < uu.rows(); ++a) uu(a, b) /= -(lambda[a] + lambda[b]);
    Matrix result = U * uu * U.transpose();
    if (V.cols() == 0) return result;
    const Matrix uv = (-lambda.cwiseInverse()).asDiagonal() * (U.transpose() * c * V);
    const Matrix mixed = U * uv * V.transpose();
    result += mixed + mixed.transpose();
    const Matrix vv = V.transpose() * c * V;
    Index at = part.first;
    for (Index b = 0; b < vv.cols(); ++b)
      for (Index a = 0; a <= b; ++a) w[at++] = -root(a, b) * vv(a, b) / (s[a] + s[b]);
    return result;
  }

  /// What dx and dS make of dY.
  static Matrix of_unknowns(const BoundaryPart& part, const Vector& dx, const Vector& dS) {
    const auto& [U, V, lambda, s] = part.ranges;
    const Index n = V.rows(), rank = V.cols();
    if (rank == 0) return Matrix::Zero(n, n);
    const Vector across = part.across * dx;
    const Matrix uv =
        (-lambda.cwiseInverse()).asDiagonal() * (across.reshaped(U.cols(), rank) * s.asDiagonal());
    const Matrix mixed = U * uv * V.transpose();
    Matrix inside(rank, rank);
    Index at = part.first;
    for (Index b = 0; b < rank; ++b)
      for (Index a = 0; a <= b; ++a) inside(a, b) = inside(b, a) = dS[at++] / root(a, b);
    return mixed + mixed.transpose() + V * inside * V.transpose();
  }

  const std::vector<const WideBlock*>& blocks_;
  const Index unknowns_;
  const int first_;  ///< of the unknowns that are not fixed
  std::vector<BoundaryPart> parts_;
  double damping_ = 0;
  Matrix A_;  ///< elements v <= w, with their roots, as dS and w
  Matrix H_;
  std::optional<numbers::Cholesky> upper_, lower_;
};

/// L, n x rank, with L L' = Y but for what a Cholesky factorisation with pivoting finds not above
/// `least`. In 100 digits; Y has a size near 1, so `least` is absolute.
Wide factor_above(const Wide& Y, double least) {
  const Index n = Y.rows();
  Wide rest = Y;
  Wide L(n, n);
  Index rank = 0;
  for (; rank < n; ++rank) {
    Index best = 0;
    for (Index i = 1; i < n; ++i)
      if (rest(i, i) > rest(best, best)) best = i;
    if (!(rest(best, best) > Decimal100(least))) break;
    L.col(rank) = rest.col(best) / sqrt(rest(best, best));
    rest -= numbers::times<Decimal100>(Wide(L.col(rank)), Wide(L.col(rank).transpose()));
  }
  return L.leftCols(rank);
}

/// V S V' without what steps leave beside the range.
void cut(Wide& Y) {
  // Between the 80 digits to which the pair is known and the smallest eigenvalues of S.
  constexpr double kLeast = 1e-60;
  const auto n = static_cast<double>(Y.rows());
  spend(n * n * n * kWideWork);
  const Wide L = factor_above(Y, kLeast);
  Y = L.cols() == 0 ? Wide::Zero(Y.rows(), Y.cols())
                    : numbers::times<Decimal100>(L, Wide(L.transpose()));
}

}  // namespace

bool refine(const std::vector<const WideBlock*>& blocks, BoundaryPair& pair) {
  constexpr double kFails = 0.5;   // a step that leaves as much of the residual is none
  constexpr double kFalls = 1e-3;  // one that leaves more wants another system
  constexpr double kMost = 1e-3, kAboveResidual = 1e3;  // of the damping
  constexpr double kLess = 1e-2;
  constexpr int kMostSystems = 8;
  System system(blocks, pair);
  PairResiduals residuals = pair_residuals(blocks, pair);
  double damping = std::clamp(kAboveResidual * residuals.worst(), kLeastDamping, kMost);
  bool is_set_up = false;
  int systems = 0;
  while (!(residuals.worst() <= kPairSettled)) {
    if (!is_set_up && (systems++ == kMostSystems || !system.set_up(pair, damping))) break;
    is_set_up = true;
    BoundaryPair next = pair;
    system.move(residuals, next);
    PairResiduals left = pair_residuals(blocks, next);
    const double share = left.share_of(residuals);
    if (!(share <= kFails)) {
      if (damping <= kLeastDamping) break;
      damping = std::max(kLeastDamping, kLess * damping);
      is_set_up = false;
      continue;
    }
    // The first system is made where the pair is still off, and damped by that.
    is_set_up = share <= kFalls && damping <= kLeastDamping;
    if (!is_set_up) damping = std::clamp(kAboveResidual * left.worst(), kLeastDamping, damping);
    pair = std::move(next);
    residuals = std::move(left);
  }
  if (!(residuals.worst() <= kPairEnough)) return false;
  for (Wide& Y : pair.Y) cut(Y);
  return true;
}

}  // namespace gainsmith::verdict
