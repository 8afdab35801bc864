#include "verdict/face_multipliers.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/stop.h"
#include "numbers/dense/rational_algebra.h"

namespace gainsmith::verdict {

namespace {

using numbers::RationalMatrix;
using Quad = numbers::MatrixOf<DoubleDouble>;

Rational fraction_of(const DoubleDouble& x) { return Rational(x.hi()) + Rational(x.lo()); }

Rational power_of_two(int exponent) {
  const Integer power = Integer(1) << static_cast<unsigned>(std::abs(exponent));
  return exponent < 0 ? Rational(Integer(1), power) : Rational(power);
}

double magnitude_of(const DoubleDouble& x) { return std::abs(x.hi()); }

/// The rows with pivots of at least `least`, the largest first, of the elimination
/// Y - y_p y_p'/Y_pp. Their number is the rank of Y up to `least`; they are returned in rising
/// order.
std::vector<int> pivots_of(Quad Y, double least) {
  std::vector<int> pivots;
  for (Eigen::Index k = 0; k < Y.rows(); ++k) {
    Eigen::Index best = 0;
    for (Eigen::Index i = 1; i < Y.rows(); ++i)
      if (Y(i, i) > Y(best, best)) best = i;
    if (!(Y(best, best) > DoubleDouble(0)) || Y(best, best).hi() < least) break;
    pivots.push_back(static_cast<int>(best));
    const Quad column = Y.col(best) / Y(best, best);
    Y -= (column * Y.row(best)).eval();
    // Rounding must not make it a pivot again.
    Y.row(best).setConstant(DoubleDouble(0));
    Y.col(best).setConstant(DoubleDouble(0));
  }
  std::sort(pivots.begin(), pivots.end());
  return pivots;
}

/// X with X A = B, by elimination; A is positive definite.
Quad right_quotient(Quad A, Quad B) {
  const Eigen::Index n = A.rows();
  for (Eigen::Index k = 0; k < n; ++k)
    for (Eigen::Index j = 0; j < n; ++j) {
      check_stop();
      if (j == k) continue;
      const DoubleDouble factor = A(k, j) / A(k, k);
      A.col(j) -= factor * A.col(k).eval();
      B.col(j) -= factor * B.col(k).eval();
    }
  for (Eigen::Index k = 0; k < n; ++k) B.col(k) /= A(k, k);
  return B;
}

/// V = Y(:, P) Y(P, P)^-1, n x |P|, in the units of the data; it has the identity in the rows P.
/// None where an element is no short fraction within `relative`; elements below sqrt(relative) are
/// 0.
std::optional<RationalMatrix> basis_of(const Quad& Y, const std::vector<int>& units,
                                       const std::vector<int>& pivots, double relative) {
  const auto n = static_cast<int>(Y.rows());
  const Quad C = right_quotient(Y(pivots, pivots), Y(Eigen::all, pivots));
  RationalMatrix V = RationalMatrix::Constant(n, std::ssize(pivots), Rational(0));
  for (int i = 0; i < n; ++i)
    for (std::size_t p = 0; p < pivots.size(); ++p) {
      const auto column = static_cast<Eigen::Index>(p);
      if (std::find(pivots.begin(), pivots.end(), i) != pivots.end()) {
        if (i == pivots[p]) V(i, column) = 1;
        continue;
      }
      const DoubleDouble& c = C(i, column);
      if (!std::isfinite(c.hi())) return std::nullopt;
      if (magnitude_of(c) <= std::sqrt(relative)) continue;
      const int unit =
          units[static_cast<std::size_t>(i)] - units[static_cast<std::size_t>(pivots[p])];
      const auto element =
          short_fraction(Rational(fraction_of(c) * power_of_two(unit)), relative, 0.1 / relative);
      if (!element) return std::nullopt;
      V(i, column) = *element;
    }
  return V;
}

/// S = Y(P, P) in the units of the data, |P| x |P|, as exact fractions of the doubles.
RationalMatrix start_of(const Quad& Y, const std::vector<int>& units,
                        const std::vector<int>& pivots) {
  const auto n = static_cast<Eigen::Index>(pivots.size());
  RationalMatrix S(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j <= i; ++j) {
      const int p = pivots[static_cast<std::size_t>(i)];
      const int q = pivots[static_cast<std::size_t>(j)];
      const int unit = units[static_cast<std::size_t>(p)] + units[static_cast<std::size_t>(q)];
      S(i, j) = S(j, i) = Rational(Y(p, q).hi()) * power_of_two(unit);
    }
  return S;
}

/// One attempt to make multipliers on given faces exact.
class Correction {
 public:
  Correction(const Faces& faces, const std::vector<FaceOfBlock>& on, std::vector<RationalMatrix> S,
             const Rational& v)
      : S_(std::move(S)), v_(v), unknowns_(faces.unknowns()) {
    for (const FaceOfBlock& face : on) {
      const RationalBlock& block = faces.blocks()[face.block];
      strict_ |= block.strict;
      std::vector<std::pair<int, RationalMatrix>> terms;
      for (const auto& [i, B] : block.terms) {
        check_stop();
        const RationalMatrix half = B.lazyProduct(face.V);
        terms.emplace_back(i, face.V.transpose().lazyProduct(half));
      }
      G_.push_back(std::move(terms));
    }
  }

  ExactMultipliers::Say run() {
    using Say = ExactMultipliers::Say;
    if (!is_near() || !correct()) return Say::nothing;
    for (const RationalMatrix& S : S_)
      if (!numbers::is_rational_definite(S)) return Say::nothing;
    if (v_ < 0) return Say::nothing;
    return strict_ || v_ > 0 ? Say::excludes : Say::restricts;
  }

  std::vector<RationalMatrix> take() { return std::move(S_); }

 private:
  static Rational product_of(const RationalMatrix& A, const RationalMatrix& B) {
    Rational sum = 0;
    for (Eigen::Index e = 0; e < A.size(); ++e)
      if (A(e) != 0) sum += A(e) * B(e);
    return sum;
  }

  /// In double: whether the residuals are so small that a correction may do.
  bool is_near() const {
    // Of the sum W_i of absolute terms.
    constexpr double kFar = 0.01;
    const double v = nearest_double(v_);
    std::vector<double> r(static_cast<std::size_t>(unknowns_) + 1, 0.0);
    std::vector<double> W = r;
    r[0] = W[0] = v;
    for (std::size_t k = 0; k < G_.size(); ++k) {
      const numbers::Matrix S =
          S_[k].unaryExpr([](const Rational& x) { return nearest_double(x); });
      const numbers::Vector root = S.diagonal().cwiseSqrt();
      const numbers::Matrix sizes = root * root.transpose();
      for (const auto& [i, exact] : G_[k]) {
        const numbers::Matrix G =
            exact.unaryExpr([](const Rational& x) { return nearest_double(x); });
        r[static_cast<std::size_t>(i)] += G.cwiseProduct(S).sum();
        W[static_cast<std::size_t>(i)] += G.cwiseAbs().cwiseProduct(sizes).sum();
      }
    }
    for (std::size_t i = 0; i < r.size(); ++i)
      if (!(std::abs(r[i]) <= kFar * W[i])) return false;
    return true;
  }

  /// S_k and v with r_i = 0 exactly: H y = r in fractions, S_k -= sum_j y_j S_k G_kj S_k,
  /// v -= y_0 v^2. H and r count i = 0 ... m. False where the equations have no solution.
  bool correct() {
    const Eigen::Index m = unknowns_ + 1;
    RationalMatrix r = RationalMatrix::Constant(m, 1, Rational(0));
    RationalMatrix H = RationalMatrix::Constant(m, m, Rational(0));
    std::vector<std::vector<RationalMatrix>> moved(G_.size());
    for (std::size_t k = 0; k < G_.size(); ++k)
      for (const auto& [j, G] : G_[k]) {
        check_stop();
        const RationalMatrix half = G.lazyProduct(S_[k]);
        moved[k].push_back(S_[k].lazyProduct(half));
        r(j) += product_of(G, S_[k]);
        for (const auto& [i, other] : G_[k]) {
          if (i > j) break;
          const Rational h = product_of(other, moved[k].back());
          H(i, j) += h;
          if (i != j) H(j, i) += h;
        }
      }
    r(0) += v_;
    H(0, 0) += v_ * v_;
    const auto steps = numbers::rational_solution(H, r);
    if (!steps) return false;
    for (std::size_t k = 0; k < G_.size(); ++k)
      for (std::size_t t = 0; t < G_[k].size(); ++t)
        if (const Rational& step = (*steps)(G_[k][t].first); step != 0) S_[k] -= step * moved[k][t];
    v_ -= (*steps)(0) * v_ * v_;
    return true;
  }

  std::vector<RationalMatrix> S_;
  Rational v_;
  int unknowns_;
  bool strict_ = false;
  std::vector<std::vector<std::pair<int, RationalMatrix>>> G_;
};

/// The rows of each block that count.
using Pattern = std::vector<std::vector<int>>;

/// One try: the ranks of `pattern`, this v, fractions within `relative`.
ExactMultipliers made_exact(const Faces& faces, const FoundMultipliers& found,
                            const Pattern& pattern, const Rational& v, double relative) {
  ExactMultipliers result;
  std::vector<RationalMatrix> start;
  for (std::size_t k = 0; k < pattern.size(); ++k) {
    if (pattern[k].empty()) continue;
    auto V = basis_of(found.Y[k], found.rows[k], pattern[k], relative);
    if (!V) return {};
    start.push_back(start_of(found.Y[k], found.rows[k], pattern[k]));
    result.faces.push_back({k, pattern[k], std::move(*V)});
  }
  if (result.faces.empty()) return {};
  Correction correction(faces, result.faces, std::move(start), v);
  result.say = correction.run();
  if (result.say != ExactMultipliers::Say::nothing) result.S = correction.take();
  return result;
}

}  // namespace

ExactMultipliers exact_multipliers(const Faces& faces, const FoundMultipliers& found) {
  // Shares of the sum of all traces and v, below which a pivot is 0; then lengths of fractions.
  constexpr double kShares[] = {1e-6, 1e-9, 1e-4, 1e-12, 1e-16, 1e-2};
  constexpr double kRelative[] = {1e-14, 1e-10, 1e-6};
  double whole = std::max(0.0, found.v);
  for (std::size_t k = 0; k < found.Y.size(); ++k)
    if (faces.blocks()[k].exact) whole += std::max(0.0, found.Y[k].trace().hi());
  if (!(whole > 0)) return {};
  std::set<std::pair<Pattern, bool>> tried;
  for (const double share : kShares) {
    Pattern pattern;
    for (std::size_t k = 0; k < found.Y.size(); ++k)
      pattern.push_back(faces.blocks()[k].exact ? pivots_of(found.Y[k], share * whole)
                                                : std::vector<int>());
    const bool has_v = found.v > share * whole;
    if (!tried.emplace(pattern, has_v).second) continue;
    for (const double relative : kRelative) {
      ExactMultipliers exact =
          made_exact(faces, found, pattern, has_v ? Rational(found.v) : Rational(0), relative);
      if (exact.say != ExactMultipliers::Say::nothing) return exact;
    }
  }
  return {};
}

std::optional<std::vector<FaceOfBlock>> fractions_near(const Faces& faces,
                                                       const FoundMultipliers& projectors,
                                                       double relative) {
  constexpr double kLeast = 1e-6;  // of a projector's diagonal, 0 or above 1/n
  std::vector<FaceOfBlock> result;
  for (std::size_t k = 0; k < projectors.Y.size(); ++k) {
    const RationalBlock& block = faces.blocks()[k];
    if (!block.exact || block.strict) continue;
    const std::vector<int> pivots = pivots_of(projectors.Y[k], kLeast);
    if (pivots.empty()) continue;
    auto V = basis_of(projectors.Y[k], projectors.rows[k], pivots, relative);
    if (!V) return std::nullopt;
    result.push_back({k, pivots, std::move(*V)});
  }
  if (result.empty()) return std::nullopt;
  return result;
}

FaceMultipliers exact_on(const Faces& faces, std::vector<FaceOfBlock> on,
                         const FoundMultipliers& found) {
  std::vector<RationalMatrix> start;
  for (const FaceOfBlock& face : on)
    start.push_back(start_of(found.Y[face.block], found.rows[face.block], face.pivots));
  Correction correction(faces, on, std::move(start), Rational(0));
  const bool shown = correction.run() == ExactMultipliers::Say::restricts;
  return {std::move(on), shown ? correction.take() : std::vector<RationalMatrix>()};
}

}  // namespace gainsmith::verdict
