#include "verdict/algebraic_multipliers.h"

#include <algorithm>
#include <array>
#include <complex>
#include <map>

#include "base/stop.h"
#include "numbers/dense/dense.h"
#include "numbers/dense/rational_algebra.h"
#include "verdict/eigenvectors.h"
#include "verdict/rational_blocks.h"

namespace gainsmith::verdict {

namespace {

using Eigen::Index;
using numbers::RationalMatrix;

constexpr double kFractionWork = 1e-7;  // seconds of one operation in long fractions
constexpr Index kLargest = 12;          // rows of a matrix whose eigenvalues are tried

/// The weights that a multiplier may have, the fewest first: the coefficients of 1, l + m, l m.
constexpr std::array<std::array<bool, 3>, 4> kWeights = {
    {{true, false, false}, {true, true, false}, {true, false, true}, {true, true, true}}};

/// A B in fractions.
RationalMatrix product(const RationalMatrix& A, const RationalMatrix& B) {
  return numbers::rational_product(A, B);
}

/// 1, l + m or l m times X.
RationalMatrix times(int weight, const RationalMatrix& X, const RationalMatrix& C) {
  if (weight == 0) return X;
  if (weight == 1) return product(X, C) + product(C.transpose(), X);
  return product(C.transpose(), product(X, C));
}

std::complex<double> rounded(const Root& root) {
  return {nearest_double(root.re), nearest_double(root.im)};
}

/// Z e in double.
numbers::ComplexVector vector_at(const std::complex<double>& l, const RationalMatrix& Z) {
  numbers::ComplexVector z = numbers::ComplexVector::Zero(Z.rows());
  for (Index j = Z.cols(); j-- > 0;)
    for (Index i = 0; i < z.size(); ++i) z[i] = z[i] * l + nearest_double(Z(i, j));
  return z;
}

/// One choice of Z_k; none for a block that has no multiplier.
using Vectors = std::vector<std::optional<RationalMatrix>>;

/// All certificates that one eigenvalue may give, in the order matrix A, start b, factor p of the
/// minimal polynomial of b, shape of the vectors Z, root. The first that excludes is returned.
class Search {
 public:
  Search(const lmi::Inequalities& of, const lmi::Lmi& lmi) : of_(of), lmi_(lmi) {}

  std::optional<AlgebraicCertificate> run() {
    const std::vector<NamedMatrix> matrices = constant_matrices(of_);
    for (const NamedMatrix& A : candidates(matrices))
      for (const RationalMatrix& b : starts_of(A.value, matrices))
        for (const Eigenvector& w : eigenvectors_from(A.value, b))
          for (const Vectors& Z : vectors(w)) {
            std::optional<std::vector<Weighted>> weighted;  // the same for all roots
            for (const Root& root : roots_of(w.p)) {
              if (!may_exclude(Z, root)) continue;
              if (!weighted) weighted = weights_for(Z, w.p);
              for (const Weighted& one : *weighted)
                if (excludes(one, root))
                  return AlgebraicCertificate{A.name, w.p, root, one.multipliers};
            }
          }
    return std::nullopt;
  }

 private:
  /// The square matrices and their transposes; then (A - c I)/r for scalars c and r, as regions of
  /// the plane have them.
  std::vector<NamedMatrix> candidates(const std::vector<NamedMatrix>& matrices) const {
    std::vector<NamedMatrix> square, scalars;
    const auto fits = [&](Index n) {
      return std::any_of(lmi_.blocks.begin(), lmi_.blocks.end(), [&](const lmi::Block& block) {
        return block.size == n || block.size == 2 * n;
      });
    };
    for (const NamedMatrix& M : matrices) {
      const Index n = M.value.rows();
      if (n != M.value.cols() || n > kLargest || !fits(n)) continue;
      square.push_back(M);
      if (n > 1) square.push_back({M.name + "'", M.value.transpose()});
    }
    for (const NamedMatrix& M : matrices)
      if (M.value.size() == 1 && of_.instance.values.contains(M.name)) scalars.push_back(M);
    std::vector<NamedMatrix> result = square;
    const Index largest = std::ranges::max_element(lmi_.blocks, {}, &lmi::Block::size)->size;
    for (const NamedMatrix& A : square)
      for (const NamedMatrix& c : scalars)
        for (const NamedMatrix& r : scalars) {
          if (2 * A.value.rows() > largest) continue;
          if (A.value.rows() == 1 || c.name == r.name || r.value(0) == 0) continue;
          RationalMatrix shifted = A.value;
          shifted.diagonal().array() -= c.value(0);
          result.push_back({"(" + A.name + " - " + c.name + "*I)/" + r.name, shifted / r.value(0)});
        }
    return result;
  }

  /// w in the blocks with its rows; w and +-l w, in either order, or w alone in those with twice as
  /// many.
  std::vector<Vectors> vectors(const Eigenvector& w) const {
    const Index n = w.V.rows(), d = w.V.cols();
    const RationalMatrix lw = product(w.V, companion(w.p));
    const RationalMatrix zero = RationalMatrix::Constant(n, d, Rational(0));
    std::vector<Vectors> result;
    for (const auto& [upper, lower] : std::vector<std::pair<RationalMatrix, RationalMatrix>>{
             {w.V, lw}, {lw, w.V}, {w.V, -lw}, {-lw, w.V}, {w.V, zero}, {zero, w.V}}) {
      Vectors Z;
      bool twice = false;
      for (const lmi::Block& block : lmi_.blocks) {
        auto& of = Z.emplace_back();
        if (block.size == n) of = w.V;
        if (block.size != 2 * n) continue;
        twice = true;
        of.emplace(2 * n, d);
        *of << upper, lower;
      }
      result.push_back(std::move(Z));
      if (!twice) break;
    }
    return result;
  }

  /// Isolated once for each p.
  const std::vector<Root>& roots_of(const Polynomial& p) {
    const auto found = roots_.find(p);
    return found != roots_.end() ? found->second : roots_.emplace(p, roots(p)).first->second;
  }

  /// Whether weights c_k >= 0 may exist, in double. f_k has the elements z_k* B_ki z_k,
  /// i = 1 ... m, and length 1; sum_k c_k f_k = 0 needs a singular Gram matrix f'f. If its kernel
  /// is one-dimensional, its vector c has no two signs. This costs far less than the kernel in
  /// fractions below.
  bool may_exclude(const Vectors& Z, const Root& root) const {
    // Relative: what counts as 0 of f_k and of an eigenvalue; the share of the other sign in c.
    constexpr double kRounding = 1e-8, kSign = 1e-3;
    const std::complex<double> l = rounded(root);
    numbers::Matrix f = numbers::Matrix::Zero(lmi_.unknowns, std::ssize(Z));
    for (Index k = 0; k < f.cols(); ++k) {
      const auto& Zk = Z[static_cast<std::size_t>(k)];
      if (!Zk) continue;
      spend(static_cast<double>(Zk->size()) * kQuadWork);
      const numbers::ComplexVector z = vector_at(l, *Zk).normalized();
      double size = 0;
      for (const auto& [i, B] : lmi_.blocks[static_cast<std::size_t>(k)].terms) {
        if (B.nonZeros() == 0) continue;
        size = std::max(size, B.coeffs().cwiseAbs().maxCoeff());
        if (i > 0) f(i - 1, k) = z.real().dot(B * z.real()) + z.imag().dot(B * z.imag());
      }
      // Without an unknown a block has a multiplier of its own.
      const double length = f.col(k).norm();
      if (length <= kRounding * size) return true;
      f.col(k) /= length;
    }
    std::vector<Index> used;
    for (Index k = 0; k < f.cols(); ++k)
      if (Z[static_cast<std::size_t>(k)]) used.push_back(k);
    if (used.empty()) return false;
    const numbers::Matrix of = f(Eigen::all, used);
    const numbers::SymmetricEigen eigen(of.transpose() * of);
    if (eigen.values()[0] >= kRounding) return false;
    if (used.size() > 1 && eigen.values()[1] < kRounding) return true;
    // The only weights there are must have one sign.
    const numbers::Vector c = eigen.vectors().col(0);
    return std::min(c.maxCoeff(), -c.minCoeff()) < kSign;
  }

  const std::vector<RationalBlock>& blocks() {
    if (blocks_.empty()) blocks_ = rational_blocks(of_, lmi_.blocks);
    return blocks_;
  }

  /// Multipliers with r_i = 0, and their constant part.
  /// The constant part sum_k c_k Z_k'B_k0 Z_k, d x d, is an element of the ring: -v.
  struct Weighted {
    std::vector<AlgebraicMultiplier> multipliers;
    RationalMatrix constant;
  };

  /// By i, the matrices Z_k'B_ki Z_k.
  std::vector<std::map<int, RationalMatrix>> forms(const Vectors& Z) {
    std::vector<std::map<int, RationalMatrix>> result(Z.size());
    for (std::size_t k = 0; k < Z.size(); ++k)
      if (Z[k] && blocks()[k].exact)
        for (const auto& [i, B] : blocks()[k].terms)
          result[k][i] = product(Z[k]->transpose(), product(B, *Z[k]));
    return result;
  }

  /// All weights of the kinds in kWeights with sum_k c_k z_k* B_ki z_k = 0, i = 1 ... m. Each
  /// equation has d x d elements in the ring Q[l, m]/(p(l), p(m)), linear in the coefficients of
  /// the c_k. The columns of the rational kernel are candidates, each with both signs.
  std::vector<Weighted> weights_for(const Vectors& Z, const Polynomial& p) {
    std::vector<Weighted> found;
    const auto of = forms(Z);
    const RationalMatrix C = companion(p);
    const Index d = C.rows();
    for (const auto& weights : kWeights) {
      spend(static_cast<double>(d * d * lmi_.unknowns * std::ssize(Z) * std::ssize(Z)) *
            kFractionWork);
      std::vector<std::pair<std::size_t, int>> places;
      std::map<int, Index> rows;  // of an unknown
      for (std::size_t k = 0; k < of.size(); ++k)
        for (int weight = 0; weight < 3; ++weight)
          if (!of[k].empty() && weights[static_cast<std::size_t>(weight)]) {
            places.emplace_back(k, weight);
            for (const auto& [i, X] : of[k])
              if (i > 0) rows.emplace(i, std::ssize(rows) * d * d);
          }
      RationalMatrix system =
          RationalMatrix::Constant(std::ssize(rows) * d * d, std::ssize(places), Rational(0));
      for (Index t = 0; t < system.cols(); ++t)
        for (const auto& [i, X] : of[places[static_cast<std::size_t>(t)].first])
          if (i > 0)
            system.block(rows[i], t, d * d, 1) =
                times(places[static_cast<std::size_t>(t)].second, X, C).reshaped();
      const RationalMatrix kernel = numbers::rational_kernel(system);
      for (Index c = 0; c < kernel.cols(); ++c)
        for (const int sign : {1, -1}) {
          Weighted& result =
              found.emplace_back(Weighted{{}, RationalMatrix::Constant(d, d, Rational(0))});
          std::map<std::size_t, RationalMatrix> W;
          for (Index t = 0; t < kernel.rows(); ++t) {
            if (kernel(t, c) == 0) continue;
            const auto& [k, weight] = places[static_cast<std::size_t>(t)];
            const Rational factor = kernel(t, c) * sign;
            RationalMatrix& Wk =
                W.try_emplace(k, RationalMatrix::Constant(2, 2, Rational(0))).first->second;
            if (weight == 1)
              Wk(0, 1) = Wk(1, 0) = factor;
            else
              Wk(weight / 2, weight / 2) = factor;
            if (const auto at = of[k].find(0); at != of[k].end())
              result.constant += times(weight, at->second, C) * factor;
          }
          for (auto& [k, Wk] : W) result.multipliers.push_back({k, *Z[k], std::move(Wk)});
        }
    }
    return found;
  }

  /// c_k >= 0, and the constant part is < 0, or 0 with c_k > 0 for a strict inequality.
  /// Decided by the enclosures of l + m and |l|^2 at the root.
  bool excludes(const Weighted& found, const Root& root) {
    bool strict = false;
    const Root::Bounded real = root.twice_real(), square = root.squared_modulus();
    for (const AlgebraicMultiplier& multiplier : found.multipliers) {
      const RationalMatrix& W = multiplier.W;
      const Rational c = W(0, 0) + W(0, 1) * real.x + W(1, 1) * square.x;
      const Rational least = c - abs(W(0, 1)) * real.error - abs(W(1, 1)) * square.error;
      if (least < 0) return false;
      strict |= least > 0 && blocks()[multiplier.block].strict;
    }
    if (numbers::is_rational_zero(found.constant)) return strict;
    const Root::Bounded value = form_at(root, found.constant);
    return value.x + value.error < 0;
  }

  const lmi::Inequalities& of_;
  const lmi::Lmi& lmi_;
  std::vector<RationalBlock> blocks_;
  std::map<Polynomial, std::vector<Root>> roots_;
};

}  // namespace

RationalMatrix weight(const Rational& c) {
  RationalMatrix W = RationalMatrix::Constant(2, 2, Rational(0));
  W(0, 0) = c;
  return W;
}

numbers::Matrix rounded(const AlgebraicMultiplier& multiplier, const Root& root) {
  const std::complex<double> l = rounded(root);
  const RationalMatrix& W = multiplier.W;
  const double c = nearest_double(W(0, 0)) + 2 * nearest_double(W(0, 1)) * l.real() +
                   nearest_double(W(1, 1)) * std::norm(l);
  const numbers::ComplexVector z = vector_at(l, multiplier.Z);
  return c * (z.real() * z.real().transpose() + z.imag() * z.imag().transpose());
}

std::optional<AlgebraicCertificate> algebraic_certificate(const lmi::Inequalities& of,
                                                          const lmi::Lmi& lmi) {
  if (!lmi.represents_points()) return std::nullopt;
  return Search(of, lmi).run();
}

}  // namespace gainsmith::verdict
