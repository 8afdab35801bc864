#include "lmi/refutation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <type_traits>

#include "base/eigen_scalars.h"
#include "numbers/dense.h"

namespace gainsmith::lmi {

namespace {

using numbers::MatrixOf;
using numbers::times;

template <class S>
using VectorOf = Eigen::Matrix<S, Eigen::Dynamic, 1>;

/// L with M = L L'; none when M is not positive definite in S.
template <class S>
std::optional<MatrixOf<S>> cholesky(const MatrixOf<S>& M) {
  using std::sqrt;
  const Eigen::Index n = M.rows();
  MatrixOf<S> L = MatrixOf<S>::Zero(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    S pivot = M(j, j);
    for (Eigen::Index k = 0; k < j; ++k) pivot -= L(j, k) * L(j, k);
    if (!(pivot > S(0))) return std::nullopt;
    L(j, j) = sqrt(pivot);
    for (Eigen::Index i = j + 1; i < n; ++i) {
      S sum = M(i, j);
      for (Eigen::Index k = 0; k < j; ++k) sum -= L(i, k) * L(j, k);
      L(i, j) = sum / L(j, j);
    }
  }
  return L;
}

/// L^-1.
template <class S>
MatrixOf<S> lower_inverse(const MatrixOf<S>& L) {
  const Eigen::Index n = L.rows();
  MatrixOf<S> inverse = MatrixOf<S>::Zero(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    inverse(j, j) = S(1) / L(j, j);
    for (Eigen::Index i = j + 1; i < n; ++i) {
      S sum(0);
      for (Eigen::Index k = j; k < i; ++k) sum += L(i, k) * inverse(k, j);
      inverse(i, j) = -sum / L(i, i);
    }
  }
  return inverse;
}

/// The sums over all blocks.
template <class S>
struct Sums {
  VectorOf<S> r;          ///< r_0 = sum <B_k0, Y_k> = -v
  Eigen::VectorXd error;  ///< of r
  Eigen::VectorXd noise;  ///< of `error` and r, what comes of coefficients that are only rounding
  Eigen::VectorXd W;
  MatrixOf<S> H;
  numbers::Matrix H_error;  ///< of H: its rounding, and what the B_ki are known to
  double strict = 0;        ///< tr of the Y_k of strict blocks
  double whole = 0;
  std::vector<bool> present;  ///< whether a term of r is not 0
  double smallest = 1;        ///< of the elements that are certainly not 0, beside their block

  explicit Sums(Eigen::Index m)
      : r(VectorOf<S>::Zero(m)),
        error(Eigen::VectorXd::Zero(m)),
        noise(error),
        W(error),
        H(MatrixOf<S>::Zero(m, m)),
        H_error(numbers::Matrix::Zero(m, m)),
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

template <class S>
double upper(const S& value) {
  using std::abs;
  if (value == S(0)) return 0;
  return static_cast<double>(as<double>(S(abs(value)))) * (1 + 1e-15) +
         std::numeric_limits<double>::denorm_min();
}

/// A factorisation of Y that succeeds shows Y + n (n + 2) u diag(Y) >= 0: `error` and `H_error` are
/// for that matrix, and cover the rounding of the sums and what the B_ki are known to.
template <class S>
void add_block(const ExactBlock<S>& block, const MatrixOf<S>& Y, bool strict, Sums<S>& sums) {
  const Eigen::Index n = Y.rows();
  constexpr double kNoEntry = 1e-48;  // what a root leaves of 100 digits
  double scale = 0;
  for (const auto& [i, B] : block.terms)
    for (Eigen::Index e = 0; e < Y.size(); ++e)
      if (upper(B.mid(e)) > 2 * B.rad(e)) scale = std::max(scale, upper(B.mid(e)));
  if (scale == 0) scale = 1;  // balanced units
  for (const auto& [i, B] : block.terms)
    for (Eigen::Index e = 0; e < Y.size(); ++e)
      if (upper(B.mid(e)) > 2 * B.rad(e))
        sums.smallest = std::min(sums.smallest, upper(B.mid(e)) / scale);
  const double rounding = 2 * static_cast<double>(n * n + 2 * n + 4) * numbers::unit_roundoff<S>();
  const numbers::Matrix sizes = Y.unaryExpr([](const S& y) { return upper(y); });
  std::vector<MatrixOf<S>> moved;           // Y B_j Y
  std::vector<numbers::Matrix> largest;     // |Y| |B_j| |Y|
  std::vector<numbers::Matrix> error_of_B;  // what B_j is known to, and the rounding
  for (const auto& [i, B] : block.terms) {
    moved.push_back(times<S>(times<S>(Y, B.mid), Y));
    const numbers::Matrix of_B = B.mid.unaryExpr([](const S& b) { return upper(b); });
    error_of_B.push_back(rounding * of_B + B.rad);
    largest.push_back(times<double>(times<double>(sizes, of_B + B.rad), sizes));
    S r(0);
    for (Eigen::Index e = 0; e < Y.size(); ++e) {
      if (B.mid(e) == S(0) || Y(e) == S(0)) continue;
      r += B.mid(e) * Y(e);
      sums.present[static_cast<std::size_t>(i)] = true;
    }
    sums.r[i] += r;
    sums.W[i] += of_B.cwiseProduct(sizes).sum();
    // sin(pi) is no entry of the data, whatever the size of its rounding.
    for (Eigen::Index e = 0; e < Y.size(); ++e)
      if (B.rad(e) > 0 && of_B(e) <= B.rad(e) * (1 + 1e-12) && B.rad(e) <= kNoEntry * scale)
        sums.noise[i] += 2 * error_of_B.back()(e) * sizes(e) * (1 + 1e-11);
    sums.error[i] += error_of_B.back().cwiseProduct(sizes).sum() * (1 + 1e-12);
  }
  for (std::size_t a = 0; a < moved.size(); ++a)
    for (std::size_t b = a; b < moved.size(); ++b) {
      const int i = block.terms[a].first;
      const int j = block.terms[b].first;
      S h(0);
      const MatrixOf<S>& B = block.terms[b].second.mid;
      for (Eigen::Index c = 0; c < n; ++c)
        for (Eigen::Index d = 0; d < n; ++d) h += moved[a](d, c) * B(d, c);
      sums.H(i, j) += h;
      const double error = (error_of_B[b].cwiseProduct(largest[a]).sum() +
                            error_of_B[a].cwiseProduct(largest[b]).sum()) *
                           (1 + 1e-12);
      sums.H_error(i, j) += error;
      if (i == j) continue;
      sums.H(j, i) += h;
      sums.H_error(j, i) += error;
    }
  const double trace = upper(S(Y.trace()));
  sums.whole += trace;
  if (strict) sums.strict += trace;
}

/// r' H^-1 r < 1, over the unknowns that stand in a block.
template <class S>
bool is_exact(const Sums<S>& sums, bool homogeneous) {
  std::vector<Eigen::Index> used;
  for (Eigen::Index i = homogeneous ? 1 : 0; i < sums.r.size(); ++i)
    if (sums.H(i, i) != S(0) || sums.H_error(i, i) > 0 || i == 0) used.push_back(i);
  const auto m = static_cast<Eigen::Index>(used.size());
  MatrixOf<S> H(m, m);
  VectorOf<S> r(m);
  numbers::Matrix error(m, m);
  for (Eigen::Index a = 0; a < m; ++a) {
    for (Eigen::Index b = 0; b < m; ++b) {
      const Eigen::Index i = used[static_cast<std::size_t>(a)];
      const Eigen::Index j = used[static_cast<std::size_t>(b)];
      H(a, b) = sums.H(i, j);
      error(a, b) = sums.H_error(i, j);
    }
    r[a] = sums.r[used[static_cast<std::size_t>(a)]];
  }
  if (!homogeneous) {
    // y_0 = v makes its own row of the residual 0.
    H(0, 0) += r[0] * r[0];
    r[0] = S(0);
  }
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
      size += upper(R(a, b)) * sums.error[used[static_cast<std::size_t>(b)]];
    norm += size * size;
  }
  // The rounding of these lines is far below the half that is left.
  return defect < 0.01 && norm * (1 + 1e-9) < 0.5;
}

/// Y, lifted where rounding left it indefinite; none when it is further from being >= 0. A lift in
/// proportion to the diagonal changes no W_i by more than its share; rows of nothing but rounding
/// need one in proportion to the whole.
template <class S>
std::optional<MatrixOf<S>> positive(const MatrixOf<S>& Y) {
  constexpr double kLifts[] = {0,     1e-97, 1e-95, 1e-93, 1e-91, 1e-89, 1e-85,
                               1e-80, 1e-78, 1e-76, 1e-74, 1e-72, 1e-70, 1e-33,
                               1e-32, 1e-31, 1e-30, 1e-29, 1e-28, 1e-27};
  const double size = upper(S(Y.trace()));
  if (size == 0 && Y.isZero()) return Y;
  for (const bool in_proportion : {true, false})
    for (const double lift : kLifts) {
      MatrixOf<S> lifted = Y;
      for (Eigen::Index i = 0; i < Y.rows(); ++i)
        lifted(i, i) += S(lift) * (in_proportion ? Y(i, i) : S(size));
      if (cholesky(lifted)) return lifted;
    }
  return std::nullopt;
}

/// Elements of nothing but rounding, and rows of such, become 0: an r_i of theirs alone is as large
/// as its W_i. What that takes from Y >= 0 is lifted again (positive()).
void clear_rounding(MatrixOf<Decimal100>& Y) {
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

template <class S>
std::vector<MatrixOf<S>> converted(const Multipliers& Y) {
  std::vector<MatrixOf<S>> result;
  for (const auto& y : Y)
    result.push_back(y.unaryExpr([](const DoubleDouble& x) { return as<S>(x); }));
  return result;
}

/// What the blocks with tr(Y_k) >= least say; the others have the multiplier 0.
template <class S>
Refutation refute_by(const std::vector<Weighed<S>>& blocks, double least, Eigen::Index m) {
  constexpr double kCounts = 1e-6;  // what strict blocks, or v, must have of all multipliers
  Refutation result;
  Sums<S> sums(m);
  bool definite = true;
  for (const Weighed<S>& weighed : blocks) {
    if (!(weighed.trace > 0 && weighed.trace >= least)) continue;
    definite &= cholesky(*weighed.Y).has_value();
    const auto lifted = positive<S>(*weighed.Y);
    if (!lifted) return result;
    add_block(*weighed.block, *lifted, weighed.strict, sums);
  }
  if (!sums.is_in_range()) return result;
  // By H, which no zeros of Y hide anything from.
  const bool homogeneous = sums.H(0, 0) == S(0) && sums.H_error(0, 0) == 0;
  const double v = static_cast<double>(as<double>(S(-sums.r[0])));
  if (definite && sums.whole > 0 && (homogeneous || v > sums.error[0]))
    result.exact = is_exact(sums, homogeneous) && (sums.strict > 0 || v > sums.error[0]);
  if (!(sums.strict >= kCounts * sums.whole || v >= kCounts * sums.whole) || sums.whole == 0)
    return result;
  double omega = 0;
  for (Eigen::Index i = 0; i < m; ++i) {
    const double residual = i == 0 ? -v : upper(sums.r[i]);
    const double missing = residual + sums.error[i] - sums.noise[i];
    if (missing <= 0) continue;
    const double share = missing / sums.W[i] * (1 + 1e-12);
    omega = share < 1 ? std::max(omega, share) : 1;
  }
  // What is of the size of an element of the data, or of the rounding, is not nothing.
  constexpr double kBeside = 1e-40;
  const double room = sums.smallest < kBeside ? 1 / sums.smallest : 1;
  result.omega = std::min(1.0, std::max(omega, numbers::unit_roundoff<S>()) * room);
  return result;
}

}  // namespace

template <class S>
std::vector<ExactBlock<S>> exact_blocks(const Inequalities& of, const Lmi& lmi,
                                        const Formulation& formulation) {
  const ExactBlocks<S> exact(of, formulation.balance);
  std::vector<ExactBlock<S>> blocks;
  for (std::size_t k = 0; k < lmi.blocks.size(); ++k)
    blocks.push_back(exact.block(lmi.blocks[k], k, formulation.releases.kept[k]));
  return blocks;
}

template <class S>
Refutation refute(const Lmi& lmi, const std::vector<ExactBlock<S>>& blocks,
                  std::vector<MatrixOf<S>> Y) {
  if constexpr (std::is_same_v<S, Decimal100>)
    for (MatrixOf<S>& y : Y) clear_rounding(y);
  // Blocks that a certificate does not need have multipliers that tend to 0 but are not.
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
  std::size_t looked_at = 0;
  for (const double share : kShares) {
    const auto count = static_cast<std::size_t>(std::count_if(
        weighed.begin(), weighed.end(),
        [&](const auto& one) { return one.trace > 0 && one.trace >= share * whole; }));
    if (share > 0 && count == looked_at) continue;
    looked_at = count;
    const auto m = static_cast<Eigen::Index>(lmi.unknowns) + 1;
    const Refutation found = refute_by(weighed, share * whole, m);
    best.exact |= found.exact;
    best.omega = std::min(best.omega, found.omega);
    if (best.exact) break;
  }
  return best;
}

template <class S>
Refutation refute(const Inequalities& of, const Lmi& lmi, const Formulation& formulation,
                  const Multipliers& Y) {
  if (!lmi.stands_for_points()) return {};
  return refute<S>(lmi, exact_blocks<S>(of, lmi, formulation), converted<S>(Y));
}

template std::vector<ExactBlock<Decimal100>> exact_blocks<Decimal100>(const Inequalities&,
                                                                      const Lmi&,
                                                                      const Formulation&);
template Refutation refute<Decimal100>(const Lmi&, const std::vector<ExactBlock<Decimal100>>&,
                                       std::vector<MatrixOf<Decimal100>>);
template Refutation refute<DoubleDouble>(const Inequalities&, const Lmi&, const Formulation&,
                                         const Multipliers&);
template Refutation refute<Decimal100>(const Inequalities&, const Lmi&, const Formulation&,
                                       const Multipliers&);

}  // namespace gainsmith::lmi
