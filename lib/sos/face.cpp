#include "sos/face.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "base/eigen_scalars.h"
#include "numbers/factor.h"
#include "numbers/rational_algebra.h"
#include "numerics/lattice.h"

namespace gainsmith::sos {

using Eigen::Index;
using numbers::RationalMatrix;

namespace {

using Wide = numbers::MatrixOf<DoubleDouble>;

/// Rows that span the rest, and those that follow from them: Q_dd = N Q_ii N', Q_di = N Q_ii.
struct Dependence {
  std::vector<Index> independent, dependent;
  Wide N;
};

/// M^-1 B, M positive definite.
Wide solution_of(Wide M, Wide B) {
  numbers::factor_in_place<DoubleDouble>(M);
  const Index n = M.rows();
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < B.cols(); ++j) {
      for (Index k = 0; k < i; ++k) B(i, j) -= M(i, k) * B(k, j);
      B(i, j) /= M(i, i);
    }
  for (Index i = n; i-- > 0;)
    for (Index j = 0; j < B.cols(); ++j) {
      for (Index k = i + 1; k < n; ++k) B(i, j) -= M(k, i) * B(k, j);
      B(i, j) /= M(i, i);
    }
  return B;
}

/// By Cholesky's factorisation with the largest pivots, of Q in the units of its diagonal.
Dependence dependence_of(const Wide& Q) {
  constexpr double kNothing = 1e-5, kNoRow = 1e-6;
  const Index n = Q.rows();
  Wide M = Q;
  std::vector<DoubleDouble> diagonal;
  double largest = 0;
  for (Index i = 0; i < n; ++i) {
    diagonal.push_back(Q(i, i));
    largest = std::max(largest, Q(i, i).hi());
  }
  std::vector<bool> taken(static_cast<std::size_t>(n), false);
  Dependence result;
  for (Index step = 0; step < n; ++step) {
    Index best = -1;
    double most = kNothing;
    for (Index i = 0; i < n; ++i) {
      const auto at = static_cast<std::size_t>(i);
      if (taken[at] || !(diagonal[at].hi() > kNoRow * largest)) continue;
      const double share = M(i, i).hi() / diagonal[at].hi();
      if (share > most) {
        best = i;
        most = share;
      }
    }
    if (best < 0) break;
    taken[static_cast<std::size_t>(best)] = true;
    result.independent.push_back(best);
    const Wide column = M.col(best);
    const DoubleDouble pivot = M(best, best);
    for (Index j = 0; j < n; ++j) {
      const DoubleDouble factor = column(j) / pivot;
      for (Index i = 0; i < n; ++i) M(i, j) -= column(i) * factor;
    }
  }
  for (Index i = 0; i < n; ++i)
    if (!taken[static_cast<std::size_t>(i)]) result.dependent.push_back(i);
  result.N = solution_of(Q(result.independent, result.independent),
                         Q(result.independent, result.dependent))
                 .transpose();
  return result;
}

/// W'z, for columns W.
std::vector<BasisPolynomial> combined(const std::vector<BasisPolynomial>& basis,
                                      const RationalMatrix& W) {
  std::vector<BasisPolynomial> result;
  for (Index k = 0; k < W.cols(); ++k) {
    std::map<Element, Rational> sum;
    for (Index a = 0; a < W.rows(); ++a)
      if (W(a, k) != 0)
        for (const auto& [element, c] : basis[static_cast<std::size_t>(a)])
          sum[element] += c * W(a, k);
    BasisPolynomial& one = result.emplace_back();
    for (const auto& [element, c] : sum)
      if (c != 0) one.emplace_back(element, c);
  }
  return result;
}

/// Whole vectors v, short, that are nearly in the kernel: v_i + sum_d N_di v_d = 0 for each
/// independent row i, by a reduced basis of the vectors (v, K times what is left of that). As many as
/// rows are dependent; none where others are as short.
std::optional<RationalMatrix> whole_kernel(const Dependence& rows, const std::vector<double>& scale,
                                           int digits) {
  const std::size_t r = rows.independent.size(), k = rows.dependent.size(), n = r + k;
  const Rational K = power_of_ten(digits);
  std::vector<numerics::IntegerVector> basis;
  for (std::size_t j = 0; j < n; ++j) basis.emplace_back(n + r, Integer(0)).at(j) = 1;
  for (std::size_t i = 0; i < r; ++i) {
    const auto row = static_cast<std::size_t>(rows.independent[i]);
    basis[row][n + i] = Integer(numerator(K));
    for (std::size_t d = 0; d < k; ++d) {
      const auto other = static_cast<std::size_t>(rows.dependent[d]);
      const DoubleDouble N = rows.N(static_cast<Index>(d), static_cast<Index>(i));
      const DoubleDouble c = DoubleDouble(scale[other] / scale[row]) * N;
      basis[other][n + i] = nearest_integer(Rational(K * (Rational(c.hi()) + Rational(c.lo()))));
    }
  }
  basis = numerics::reduced_basis(std::move(basis));
  std::vector<double> lengths;
  for (const auto& vector : basis) {
    double sum = 0;
    for (const Integer& x : vector) sum += std::pow(nearest_double(Rational(x)), 2);
    lengths.push_back(std::sqrt(sum));
  }
  constexpr double kShorter = 10;
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::stable_sort(order, {}, [&](std::size_t at) { return lengths[at]; });
  if (r > 0 && lengths[order[k - 1]] * kShorter > lengths[order[k]]) return std::nullopt;
  RationalMatrix result(static_cast<Index>(k), static_cast<Index>(n));
  for (std::size_t v = 0; v < k; ++v)
    for (std::size_t j = 0; j < n; ++j)
      result(static_cast<Index>(v), static_cast<Index>(j)) = basis[order[v]][j];
  return result;
}

/// [I; N] over the independent and the dependent rows, for the kernel [-N', I] in fractions.
std::optional<RationalMatrix> spanning(const Dependence& rows, const RationalMatrix& kernel) {
  const RationalMatrix all = kernel(Eigen::all, rows.dependent);
  const auto inverse = numbers::rational_inverse(all);
  if (!inverse) return std::nullopt;
  const RationalMatrix along = kernel(Eigen::all, rows.independent);
  const RationalMatrix N = -numbers::rational_product(*inverse, along);
  RationalMatrix W = RationalMatrix::Zero(kernel.cols(), N.cols());
  for (Index j = 0; j < N.cols(); ++j) {
    W(rows.independent[static_cast<std::size_t>(j)], j) = 1;
    for (Index i = 0; i < N.rows(); ++i)
      W(rows.dependent[static_cast<std::size_t>(i)], j) = N(i, j);
  }
  return W;
}

}  // namespace

std::optional<Program> restricted_to_faces(const Program& program, const Point& point) {
  std::vector<Dependence> rows;
  bool some = false;
  for (const auto& Q : point.balanced) {
    rows.push_back(dependence_of(Q));
    some = some || !rows.back().dependent.empty();
  }
  if (!some) return std::nullopt;
  for (const int digits : {4, 7, 11, 16, 21}) {
    Program result = program;
    bool is_found = true;
    for (std::size_t g = 0; g < rows.size() && is_found; ++g) {
      if (rows[g].dependent.empty()) continue;
      Gram& gram = result.grams[g];
      const auto kernel = whole_kernel(rows[g], gram.scale, digits);
      const auto W = kernel ? spanning(rows[g], *kernel) : std::nullopt;
      is_found = W.has_value();
      if (!is_found) break;
      gram.basis = combined(gram.basis, *W);
      std::vector<double> scale;
      for (const Index i : rows[g].independent)
        scale.push_back(gram.scale[static_cast<std::size_t>(i)]);
      gram.scale = std::move(scale);
    }
    if (is_found && agree(eliminate(result, equations_of(result)))) return result;
  }
  return std::nullopt;
}

}  // namespace gainsmith::sos
