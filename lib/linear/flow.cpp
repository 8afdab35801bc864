#include "linear/flow.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "linear/tolerances.h"
#include "numerics/balance.h"

namespace gainsmith::linear {

namespace {

using Eigen::Index;
using numbers::times;

/// Terms that are left out are below this part of the largest one.
constexpr double kLeftOut = 1e-110;

double largest(const Wide& matrix) {
  double most = 0;
  for (Index e = 0; e < matrix.size(); ++e)
    most = std::max(most, std::abs(static_cast<double>(matrix(e))));
  return most;
}

/// Element (i, j) times 2^(left_i + right_j).
Wide scaled(const Wide& matrix, const std::vector<int>& left, const std::vector<int>& right) {
  Wide result = matrix;
  for (Index i = 0; i < matrix.rows(); ++i)
    for (Index j = 0; j < matrix.cols(); ++j)
      result(i, j) = ldexp(matrix(i, j),
                           left[static_cast<std::size_t>(i)] + right[static_cast<std::size_t>(j)]);
  return result;
}

std::vector<int> units_of(const Wide& A) {
  return numerics::balance(numbers::Matrix(
      A.unaryExpr([](const Decimal100& x) { return std::abs(static_cast<double>(x)); })));
}

/// D^-1 A D.
Wide balanced(const Wide& A, const std::vector<int>& units) {
  std::vector<int> inverse;
  for (const int exponent : units) inverse.push_back(-exponent);
  return scaled(A, inverse, units);
}

/// Terms one of the other until they are negligible: those of exponentials of a norm up to 1.
template <class Next>
std::vector<Wide> terms_from(Wide first, const Next& next) {
  std::vector<Wide> terms{std::move(first)};
  double most = largest(terms.front());
  for (int k = 1;; ++k) {
    Wide term = next(terms.back(), k);
    const double size = largest(term);
    most = std::max(most, size);
    terms.push_back(std::move(term));
    if (k > 2 && size <= kLeftOut * most) return terms;
  }
}

/// sum_k terms_k share^k by Horner's scheme.
Wide sum_of(const std::vector<Wide>& terms, const Decimal100& share) {
  Wide sum = terms.back();
  for (std::size_t k = terms.size() - 1; k-- > 0;) sum = Wide(sum * share + terms[k]);
  return sum;
}

}  // namespace

Wide moved(const Wide& E, const Wide& Q) {
  return times<Decimal100>(E.transpose(), times<Decimal100>(Q, E));
}

double flow_norm(const Wide& A, double length) {
  const Wide small = balanced(A, units_of(A));
  double norm = 0;
  for (Index j = 0; j < A.cols(); ++j) {
    double sum = 0;
    for (Index i = 0; i < A.rows(); ++i) sum += std::abs(static_cast<double>(small(i, j)));
    norm = std::max(norm, sum);
  }
  return norm * length;
}

WideFlow::WideFlow(const Wide& A, const std::vector<Wide>& forms, double longest)
    : units_(units_of(A)) {
  // |A| unit <= 1/2 in balanced units: the series converges at once.
  for (double norm = flow_norm(A, longest); norm > 0.5; norm /= 2) ++doublings_;
  unit_ = longest > 0 ? std::ldexp(longest, -doublings_) : 1;
  const Wide step = balanced(A, units_) * Decimal100(unit_);
  const Wide turned = step.transpose();
  flow_ = terms_from(Wide::Identity(A.rows(), A.cols()), [&](const Wide& term, int k) {
    return Wide(times<Decimal100>(term, step) / Decimal100(k));
  });
  for (const Wide& Q : forms)
    integrals_.push_back(
        terms_from(scaled(Q, units_, units_) * Decimal100(unit_), [&](const Wide& term, int k) {
          return Wide((times<Decimal100>(turned, term) + times<Decimal100>(term, step)) /
                      Decimal100(k + 1));
        }));
}

WideFlow::Values WideFlow::operator()(const Decimal100& s) const {
  const Decimal100 share = ldexp(Decimal100(s / Decimal100(unit_)), -doublings_);
  Values values{sum_of(flow_, share), {}};
  for (const std::vector<Wide>& terms : integrals_)
    values.W.emplace_back(sum_of(terms, share) * share);
  // E(2 s) = E(s)^2 needs the old E in W(2 s) = W(s) + E(s)' W(s) E(s): W goes first.
  for (int k = 0; k < doublings_; ++k) {
    for (Wide& W : values.W) W += moved(values.E, W);
    values.E = times<Decimal100>(values.E, values.E);
  }
  std::vector<int> inverse;
  for (const int exponent : units_) inverse.push_back(-exponent);
  values.E = scaled(values.E, units_, inverse);
  for (Wide& W : values.W) W = scaled(W, inverse, inverse);
  return values;
}

RankFactors rank_factors(const Wide& matrix) {
  const Index n = matrix.rows();
  const Index columns = matrix.cols();
  // Elimination with pivots in the whole of what is left; X(i, k) is how much of pivot row k is in
  // row i.
  Wide rest = matrix;
  Wide X = Wide::Zero(n, std::min(n, columns));
  std::vector<Index> rows;
  std::vector<char> taken(static_cast<std::size_t>(n), 0);
  const Decimal100 least = Decimal100(largest(matrix)) * Decimal100(kCoefficientNoise);
  while (true) {
    Index row = -1, column = -1;
    Decimal100 pivot = least;
    for (Index i = 0; i < n; ++i)
      for (Index j = 0; j < columns && taken[static_cast<std::size_t>(i)] == 0; ++j)
        if (abs(rest(i, j)) > pivot) {
          pivot = abs(rest(i, j));
          row = i;
          column = j;
        }
    if (row < 0) break;
    const auto k = static_cast<Index>(rows.size());
    taken[static_cast<std::size_t>(row)] = 1;
    rows.push_back(row);
    for (Index i = 0; i < n; ++i) {
      if (taken[static_cast<std::size_t>(i)] != 0) continue;
      const Decimal100 factor = rest(i, column) / rest(row, column);
      X(i, k) = factor;
      for (Index j = 0; j < columns; ++j) rest(i, j) -= factor * rest(row, j);
    }
    X(row, k) = Decimal100(1);
  }
  // matrix = X U with U the eliminated pivot rows, and D = (rows of X) U, so B = X (rows of X)^-1:
  // these rows are lower triangular with ones.
  const auto r = static_cast<Index>(rows.size());
  RankFactors factors{X.leftCols(r), Wide::Zero(r, columns), rows};
  for (Index k = 0; k < r; ++k) factors.D.row(k) = matrix.row(rows[static_cast<std::size_t>(k)]);
  for (Index k = r; k-- > 0;)
    for (Index j = 0; j < k; ++j) {
      const Decimal100 factor = factors.B(rows[static_cast<std::size_t>(k)], j);
      for (Index i = 0; i < n; ++i) factors.B(i, j) -= factor * factors.B(i, k);
    }
  return factors;
}

/// Cholesky with diagonal pivoting (Higham 2002, section 10.3). What is below kCoefficientNoise of
/// the largest element counts as 0.
bool is_semidefinite(Wide Q) {
  const Index n = Q.rows();
  const Decimal100 noise = Decimal100(largest(Q)) * Decimal100(kCoefficientNoise);
  std::vector<char> taken(static_cast<std::size_t>(n), 0);
  for (Index step = 0; step < n; ++step) {
    Index pivot = -1;
    for (Index i = 0; i < n; ++i) {
      if (taken[static_cast<std::size_t>(i)] != 0) continue;
      if (Q(i, i) < -noise) return false;
      if (pivot < 0 || Q(i, i) > Q(pivot, pivot)) pivot = i;
    }
    if (Q(pivot, pivot) <= noise) {
      // Nothing may be left beside a diagonal of zeros.
      for (Index i = 0; i < n; ++i)
        for (Index j = 0; j < n; ++j)
          if (taken[static_cast<std::size_t>(i)] == 0 && taken[static_cast<std::size_t>(j)] == 0 &&
              abs(Q(i, j)) > noise)
            return false;
      return true;
    }
    taken[static_cast<std::size_t>(pivot)] = 1;
    for (Index i = 0; i < n; ++i) {
      if (taken[static_cast<std::size_t>(i)] != 0) continue;
      const Decimal100 factor = Q(i, pivot) / Q(pivot, pivot);
      for (Index j = 0; j < n; ++j)
        if (taken[static_cast<std::size_t>(j)] == 0) Q(i, j) -= factor * Q(pivot, j);
    }
  }
  return true;
}

}  // namespace gainsmith::linear
