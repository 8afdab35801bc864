#include "packs/linear_flow.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "bounded/tolerances.h"

namespace gainsmith::packs {

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

/// Terms one of the other until they are negligible: those of exponentials fall from `falling` on.
template <class Next>
std::vector<Wide> terms_from(Wide first, int falling, const Next& next) {
  std::vector<Wide> terms{std::move(first)};
  double most = largest(terms.front());
  for (int k = 1;; ++k) {
    Wide term = next(terms.back(), k);
    const double size = largest(term);
    most = std::max(most, size);
    terms.push_back(std::move(term));
    if (k > falling && size <= kLeftOut * most) return terms;
  }
}

}  // namespace

double flow_norm(const Wide& A, double length) {
  double norm = 0;
  for (Index j = 0; j < A.cols(); ++j) {
    double sum = 0;
    for (Index i = 0; i < A.rows(); ++i) sum += std::abs(static_cast<double>(A(i, j)));
    norm = std::max(norm, sum);
  }
  return norm * length;
}

MatrixSeries MatrixSeries::flow(const Wide& A, double longest) {
  MatrixSeries series;
  series.unit_ = longest > 0 ? longest : 1;
  const Wide step = A * Decimal100(series.unit_);
  const int falling = static_cast<int>(2 * flow_norm(A, series.unit_)) + 2;
  series.terms_ =
      terms_from(Wide::Identity(A.rows(), A.cols()), falling, [&](const Wide& term, int k) {
        return Wide(times<Decimal100>(term, step) / Decimal100(k));
      });
  return series;
}

MatrixSeries MatrixSeries::integral(const Wide& A, const Wide& Q, double longest) {
  MatrixSeries series;
  series.unit_ = longest > 0 ? longest : 1;
  const Wide step = A * Decimal100(series.unit_);
  const Wide turned = step.transpose();
  const int falling = static_cast<int>(4 * flow_norm(A, series.unit_)) + 2;
  series.terms_ =
      terms_from(Q * Decimal100(series.unit_), falling, [&](const Wide& term, int k) {
        return Wide((times<Decimal100>(turned, term) + times<Decimal100>(term, step)) /
                    Decimal100(k + 1));
      });
  series.terms_.insert(series.terms_.begin(), Wide::Zero(A.rows(), A.cols()));
  return series;
}

Wide MatrixSeries::operator()(const Decimal100& s) const {
  const Decimal100 share = s / Decimal100(unit_);
  Wide sum = terms_.back();
  for (std::size_t k = terms_.size() - 1; k-- > 0;) sum = Wide(sum * share + terms_[k]);
  return sum;
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
  const Decimal100 least = Decimal100(largest(matrix)) * Decimal100(bounded::kCoefficientNoise);
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
  RankFactors factors{X.leftCols(r), Wide::Zero(r, columns)};
  for (Index k = 0; k < r; ++k) factors.D.row(k) = matrix.row(rows[static_cast<std::size_t>(k)]);
  for (Index k = r; k-- > 0;)
    for (Index j = 0; j < k; ++j) {
      const Decimal100 factor = factors.B(rows[static_cast<std::size_t>(k)], j);
      for (Index i = 0; i < n; ++i) factors.B(i, j) -= factor * factors.B(i, k);
    }
  return factors;
}

bool is_semidefinite(Wide Q) {
  const Index n = Q.rows();
  const Decimal100 noise = Decimal100(largest(Q)) * Decimal100(bounded::kCoefficientNoise);
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

}  // namespace gainsmith::packs
