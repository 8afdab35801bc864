#include "verdict/refutation.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <type_traits>

#include "base/eigen_scalars.h"
#include "base/stop.h"
#include "numbers/dense/dense.h"
#include "verdict/exactness.h"
#include "verdict/implied_equations.h"
#include "verdict/wide_algebra.h"

namespace gainsmith::verdict {

namespace {

using numbers::MatrixOf;
/// The sums over all blocks of terms in B_ki and Y_k, i = 0 ... m, with bounds of their errors.
template <class S>
struct Sums {
  VectorOf<S> r;          ///< r_0 = sum <B_k0, Y_k> = -v
  Eigen::VectorXd error;  ///< of r
  Eigen::VectorXd noise;  ///< of `error` and r, what comes of coefficients that are only rounding
  Eigen::VectorXd W;      ///< W_i = sum_k <|B_ki|, |Y_k|>
  double strict = 0;      ///< tr of the Y_k of strict blocks
  double whole = 0;
  std::vector<bool> present;  ///< whether a term of r is not 0
  double smallest = 1;        ///< of the elements that are certainly not 0, beside their block

  explicit Sums(Eigen::Index m)
      : r(VectorOf<S>::Zero(m)),
        error(Eigen::VectorXd::Zero(m)),
        noise(error),
        W(error),
        present(static_cast<std::size_t>(m), false) {}

  /// Whether double, in which the bounds are, holds the size of every r_i.
  bool is_in_range() const {
    constexpr double kLeast = 1e-250;
    constexpr double kMost = 1e250;
    for (Eigen::Index i = 0; i < W.size(); ++i)
      if (present[static_cast<std::size_t>(i)] && !(W[i] >= kLeast && W[i] <= kMost)) return false;
    return true;
  }
};

/// The elements that are certainly not 0 give the scale of a block, and the smallest of them.
template <class S>
double scale_of(const ExactBlock<S>& block, double& smallest) {
  double scale = 0;
  const auto visit = [&](const auto& use) {
    for (const auto& [i, elements] : block.terms)
      for (const auto& e : elements)
        if (const double size = upper(e.mid); size > 2 * e.rad) use(size);
  };
  visit([&](double size) { scale = std::max(scale, size); });
  if (scale == 0) return 1;  // balanced units
  visit([&](double size) { smallest = std::min(smallest, size / scale); });
  return scale;
}

/// A factorisation of Y that succeeds shows Y + n (n + 2) u diag(Y) >= 0: `error` is for that
/// matrix, and covers the rounding of the sums and what the B_ki are known to.
template <class S>
void add_block(const ExactBlock<S>& block, const MatrixOf<S>& Y, bool strict, Sums<S>& sums) {
  const Eigen::Index n = Y.rows();
  constexpr double kNoEntry = 1e-48;  // what a root leaves of 100 digits
  const double scale = scale_of(block, sums.smallest);
  const double rounding = 2 * static_cast<double>(n * n + 2 * n + 4) * numbers::unit_roundoff<S>();
  const numbers::Matrix sizes = Y.unaryExpr([](const S& y) { return upper(y); });
  for (const auto& [i, elements] : block.terms) {
    spend(static_cast<double>(elements.size()) * work_of<S>());
    S r(0);
    for (const auto& e : elements) {
      const double b = upper(e.mid), y = sizes(e.row, e.column);
      const double error = rounding * b + e.rad;
      sums.W[i] += b * y;
      sums.error[i] += error * y * (1 + 1e-12);
      // sin(pi) is no entry of the data, whatever the size of its rounding.
      if (e.rad > 0 && b <= e.rad * (1 + 1e-12) && e.rad <= kNoEntry * scale)
        sums.noise[i] += 2 * error * y * (1 + 1e-11);
      if (e.mid == S(0) || y == 0) continue;
      r += e.mid * Y(e.row, e.column);
      sums.present[static_cast<std::size_t>(i)] = true;
    }
    sums.r[i] += r;
  }
  const double trace = upper(S(Y.trace()));
  sums.whole += trace;
  if (strict) sums.strict += trace;
}

/// Y, lifted where rounding left it indefinite; none when it is further from being >= 0. A lift in
/// proportion to the diagonal changes no W_i by more than its share; rows of nothing but rounding
/// need one in proportion to the whole.
template <class S>
std::optional<MatrixOf<S>> positive(const MatrixOf<S>& Y) {
  constexpr double kLifts[] = {0,     1e-97, 1e-95, 1e-93, 1e-91, 1e-89, 1e-85,
                               1e-80, 1e-78, 1e-76, 1e-74, 1e-72, 1e-70, 1e-33,
                               1e-32, 1e-31, 1e-30, 1e-29, 1e-28, 1e-27};
  // Rows of zeros need nothing, and stay so.
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < Y.rows(); ++i)
    if (!Y.row(i).isZero(S(0))) rows.push_back(i);
  if (rows.empty()) return Y;
  const MatrixOf<S> inner = Y(rows, rows);
  const double size = upper(S(Y.trace()));
  for (const bool in_proportion : {true, false})
    for (const double lift : kLifts) {
      MatrixOf<S> lifted = inner;
      for (Eigen::Index i = 0; i < inner.rows(); ++i)
        lifted(i, i) += S(lift) * (in_proportion ? inner(i, i) : S(size));
      if (!cholesky(lifted)) continue;
      MatrixOf<S> result = Y;
      result(rows, rows) = lifted;
      return result;
    }
  return std::nullopt;
}

/// Elements of nothing but rounding, and rows of such, become 0: an r_i of theirs alone is as large
/// as its W_i. What that takes from Y >= 0 is lifted again (positive()).
void clear_rounding(MatrixOf<Decimal100>& Y) {
  // Relative: of sqrt(Y_ii Y_jj), and of tr Y.
  constexpr double kElement = 1e-78;
  constexpr double kRow = 1e-85;
  const Eigen::Index n = Y.rows();
  const Decimal100 least = Decimal100(kRow) * Y.trace();
  for (Eigen::Index i = 0; i < n; ++i)
    if (Y.row(i).cwiseAbs().maxCoeff() <= least) {
      Y.row(i).setConstant(Decimal100(0));
      Y.col(i).setConstant(Decimal100(0));
    }
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < i; ++j)
      if (abs(Y(i, j)) <= Decimal100(kElement) * sqrt(Decimal100(abs(Y(i, i) * Y(j, j)))))
        Y(i, j) = Y(j, i) = Decimal100(0);
}

/// One block with its multiplier.
template <class S>
struct Weighed {
  const ExactBlock<S>* block = nullptr;
  const MatrixOf<S>* Y = nullptr;
  double trace = 0;
  bool strict = true;
};

/// The multipliers of 31 digits in S.
template <class S>
std::vector<MatrixOf<S>> converted(const Multipliers& Y) {
  std::vector<MatrixOf<S>> result;
  for (const auto& y : Y)
    result.push_back(y.unaryExpr([](const DoubleDouble& x) { return as<S>(x); }));
  return result;
}

/// L, n x rank, with Y = L L' but for what is left after pivots above `small` times the largest
/// one: a Cholesky factorisation with complete pivoting, in double.
numbers::Matrix factor_of(numbers::Matrix Y, double small) {
  const Eigen::Index n = Y.rows();
  numbers::Matrix L(n, n);
  Eigen::Index rank = 0, best = 0;
  const double least = small * Y.diagonal().maxCoeff();
  while (rank < n && Y.diagonal().maxCoeff(&best) > least) {
    L.col(rank) = Y.col(best) / std::sqrt(Y(best, best));
    Y -= L.col(rank) * L.col(rank).transpose();
    ++rank;
  }
  return L.leftCols(rank);
}

/// Whether a certificate without any residual is near the multipliers (exactness.h).
/// With constant parts v > 0 must be certain; without them a strict block must have a multiplier.
template <class S>
bool is_exact(const std::vector<Weighed<S>>& blocks, const Sums<S>& sums, Eigen::Index m,
              Exactness exactness) {
  constexpr double kSmall =
      1e-13;  // of the largest pivot: what is rounding of multipliers in double
  bool constant = false;
  std::vector<FactoredBlock<S>> factored;
  for (const Weighed<S>& weighed : blocks) {
    for (const auto& term : weighed.block->terms) constant |= term.first == 0;
    factored.push_back(
        {weighed.block,
         factor_of(weighed.Y->unaryExpr([](const S& y) { return as<double>(y); }), kSmall)});
  }
  const double v = as<double>(S(-sums.r[0]));
  if (sums.whole == 0 || (constant && !(v > sums.error[0])) ||
      !(sums.strict > 0 || v > sums.error[0]))
    return false;
  // Those of the products of the factors, which are other multipliers.
  Sums<S> of_factors(m);
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    const MatrixOf<S> L = factored[k].L.template cast<S>();
    spend(std::pow(static_cast<double>(L.rows()), 3) * work_of<S>());
    add_block(*blocks[k].block, numbers::times<S>(L, L.transpose()), blocks[k].strict, of_factors);
  }
  const double value = as<double>(S(-of_factors.r[0]));
  const bool counts = constant ? value > of_factors.error[0] : of_factors.strict > 0;
  const ResidualsInDouble residuals{
      of_factors.r.unaryExpr([](const S& r) { return as<double>(r) * (1 + 1e-15); }),
      of_factors.error};
  if (counts && of_factors.is_in_range() && is_exact_in_double(factored, residuals, constant))
    return true;
  if (exactness == Exactness::in_double) return false;
  std::vector<WeighedBlock<S>> weighed;
  for (const Weighed<S>& one : blocks) {
    if (!cholesky(*one.Y)) return false;
    weighed.push_back({one.block, one.Y});
  }
  return is_exact_in_wide(weighed, sums.r, sums.error, constant);
}

/// What the blocks with tr(Y_k) >= least say; the others have the multiplier 0.
/// The backward error is max over i of (|r_i| + error_i - noise_i) / W_i, at least the unit
/// roundoff. For i = 0 only r_0 > 0, that is v < 0, counts.
template <class S>
Refutation refute_by(const std::vector<Weighed<S>>& blocks, double least, Eigen::Index m,
                     Exactness exactness) {
  constexpr double kCounts = 1e-6;  // what strict blocks, or v, must have of all multipliers
  Refutation result;
  Sums<S> sums(m);
  std::vector<Weighed<S>> kept;
  for (const Weighed<S>& weighed : blocks) {
    if (!(weighed.trace > 0 && weighed.trace >= least)) continue;
    const auto lifted = positive<S>(*weighed.Y);
    if (!lifted) return result;
    add_block(*weighed.block, *lifted, weighed.strict, sums);
    kept.push_back(weighed);
  }
  if (!sums.is_in_range()) return result;
  const auto v = as<double>(S(-sums.r[0]));
  result.exact = is_exact(kept, sums, m, exactness);
  if (!(sums.strict >= kCounts * sums.whole || v >= kCounts * sums.whole) || sums.whole == 0)
    return result;
  double backward_error = 0;
  for (Eigen::Index i = 0; i < m; ++i) {
    const double residual = i == 0 ? -v : upper(sums.r[i]);
    const double missing = residual + sums.error[i] - sums.noise[i];
    if (missing <= 0) continue;
    const double share = missing / sums.W[i] * (1 + 1e-12);
    backward_error = share < 1 ? std::max(backward_error, share) : 1;
  }
  // What is of the size of an element of the data, or of the rounding, is not nothing.
  constexpr double kBeside = 1e-40;
  const double room = sums.smallest < kBeside ? 1 / sums.smallest : 1;
  result.backward_error =
      std::min(1.0, std::max(backward_error, numbers::unit_roundoff<S>()) * room);
  return result;
}

}  // namespace

template <class S>
std::vector<ExactBlock<S>> exact_blocks(const lmi::Inequalities& of, const lmi::Lmi& lmi,
                                        const lmi::Formulation& formulation) {
  const ExactBlocks<S> exact(of, formulation.balance);
  std::vector<ExactBlock<S>> blocks;
  for (std::size_t k = 0; k < lmi.blocks.size(); ++k)
    blocks.push_back(exact.block(lmi.blocks[k], k, formulation.free_variables.kept[k]));
  return blocks;
}

template <class S>
Refutation refute(const lmi::Lmi& lmi, const std::vector<ExactBlock<S>>& blocks,
                  std::vector<MatrixOf<S>> Y, Exactness exactness) {
  if constexpr (std::is_same_v<S, Decimal100>)
    for (MatrixOf<S>& y : Y) clear_rounding(y);
  // Blocks that a certificate does not need have multipliers that tend to 0 but are not.
  // Shares of the sum of all traces: blocks with smaller multipliers are left out, one try each.
  constexpr double kShares[] = {0, 1e-24, 1e-16, 1e-12, 1e-8, 1e-4};
  Refutation best;
  best.digits = std::is_same_v<S, DoubleDouble> ? kQuadDigits : kWideDigits;
  std::vector<Weighed<S>> weighed;
  double whole = 0;
  for (std::size_t k = 0; k < lmi.blocks.size(); ++k) {
    const auto trace = static_cast<double>(as<double>(S(Y[k].trace())));
    weighed.push_back({&blocks[k], &Y[k], trace, lmi.blocks[k].strict});
    whole += trace;
  }
  std::size_t checked = 0;
  for (const double share : kShares) {
    const auto count = static_cast<std::size_t>(std::count_if(
        weighed.begin(), weighed.end(),
        [&](const auto& one) { return one.trace > 0 && one.trace >= share * whole; }));
    if (share > 0 && count == checked) continue;
    checked = count;
    const auto m = static_cast<Eigen::Index>(lmi.unknowns) + 1;
    const Refutation found = refute_by(weighed, share * whole, m, exactness);
    best.exact |= found.exact;
    best.backward_error = std::min(best.backward_error, found.backward_error);
    if (best.exact) break;
  }
  return best;
}

template <class S>
Refutation refute(const lmi::Inequalities& of, const lmi::Lmi& lmi,
                  const lmi::Formulation& formulation, const Multipliers& Y, Exactness exactness) {
  auto blocks = exact_blocks<S>(of, lmi, formulation);
  drop_implied(of, lmi, formulation, blocks);
  return refute<S>(lmi, blocks, converted<S>(Y), exactness);
}

template std::vector<ExactBlock<Decimal100>> exact_blocks<Decimal100>(const lmi::Inequalities&,
                                                                      const lmi::Lmi&,
                                                                      const lmi::Formulation&);
template Refutation refute<Decimal100>(const lmi::Lmi&, const std::vector<ExactBlock<Decimal100>>&,
                                       std::vector<MatrixOf<Decimal100>>, Exactness);
template Refutation refute<DoubleDouble>(const lmi::Inequalities&, const lmi::Lmi&,
                                         const lmi::Formulation&, const Multipliers&, Exactness);
template Refutation refute<Decimal100>(const lmi::Inequalities&, const lmi::Lmi&,
                                       const lmi::Formulation&, const Multipliers&, Exactness);

}  // namespace gainsmith::verdict
