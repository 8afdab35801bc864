#include "numbers/lattice.h"

#include <algorithm>
#include <utility>

#include "numbers/rational_algebra.h"

namespace gainsmith::numbers {

namespace {

using std::size_t;

Integer dot(const IntegerVector& a, const IntegerVector& b) {
  Integer sum = 0;
  for (size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// Cohen's algorithm: d_i are the Gram determinants, d(0) = 1, lambda_ij = d_j mu_ij.
class Reduction {
 public:
  explicit Reduction(std::vector<IntegerVector> basis)
      : b_(std::move(basis)), d_(b_.size() + 1, Integer(1)), lambda_(b_.size()) {
    for (auto& row : lambda_) row.assign(b_.size(), Integer(0));
  }

  std::vector<IntegerVector> run() {
    if (b_.size() < 2) return std::move(b_);
    orthogonalise(0);
    size_t known = 0;
    for (size_t k = 1; k < b_.size();) {
      if (k > known) orthogonalise(known = k);
      reduce(k, k - 1);
      const Integer& l = lambda_[k][k - 1];
      if (4 * (d_[k + 1] * d_[k - 1] + l * l) < 3 * d_[k] * d_[k]) {
        swap(k, known);
        k = std::max<size_t>(1, k - 1);
        continue;
      }
      for (size_t j = k - 1; j-- > 0;) reduce(k, j);
      ++k;
    }
    return std::move(b_);
  }

 private:
  void orthogonalise(size_t k) {
    for (size_t j = 0; j <= k; ++j) {
      Integer u = dot(b_[k], b_[j]);
      for (size_t i = 0; i < j; ++i) u = (d_[i + 1] * u - lambda_[k][i] * lambda_[j][i]) / d_[i];
      (j < k ? lambda_[k][j] : d_[k + 1]) = u;
    }
  }

  void reduce(size_t k, size_t l) {
    if (2 * abs(lambda_[k][l]) <= d_[l + 1]) return;
    const Integer q = nearest_integer(Rational(lambda_[k][l], d_[l + 1]));
    for (size_t i = 0; i < b_[k].size(); ++i) b_[k][i] -= q * b_[l][i];
    lambda_[k][l] -= q * d_[l + 1];
    for (size_t i = 0; i < l; ++i) lambda_[k][i] -= q * lambda_[l][i];
  }

  void swap(size_t k, size_t known) {
    std::swap(b_[k], b_[k - 1]);
    for (size_t j = 0; j + 1 < k; ++j) std::swap(lambda_[k][j], lambda_[k - 1][j]);
    const Integer l = lambda_[k][k - 1];
    const Integer B = (d_[k - 1] * d_[k + 1] + l * l) / d_[k];
    for (size_t i = k + 1; i <= known; ++i) {
      const Integer t = lambda_[i][k];
      lambda_[i][k] = (d_[k + 1] * lambda_[i][k - 1] - l * t) / d_[k];
      lambda_[i][k - 1] = (B * t + l * lambda_[i][k]) / d_[k + 1];
    }
    d_[k] = B;
  }

  std::vector<IntegerVector> b_;
  std::vector<Integer> d_;
  std::vector<IntegerVector> lambda_;
};

/// The equations without fractions, one a row, the last column b. None when a row shows that there
/// are no whole solutions.
std::optional<std::vector<IntegerVector>> whole_rows(const RationalMatrix& A,
                                                     const RationalMatrix& b) {
  std::vector<IntegerVector> rows;
  for (Eigen::Index r = 0; r < A.rows(); ++r) {
    Integer common = denominator(b(r));
    for (Eigen::Index c = 0; c < A.cols(); ++c) common = lcm(common, denominator(A(r, c)));
    IntegerVector row;
    Integer shared = 0;
    for (Eigen::Index c = 0; c < A.cols(); ++c) {
      row.push_back(numerator(Rational(A(r, c) * Rational(common))));
      shared = gcd(shared, row.back());
    }
    row.push_back(numerator(Rational(b(r) * Rational(common))));
    if (shared == 0 || row.back() % shared != 0) return std::nullopt;
    for (Integer& element : row) element /= shared;
    rows.push_back(std::move(row));
  }
  return rows;
}

/// X moved by the vectors of the basis to a point near `near`.
void move_near(const std::vector<IntegerVector>& basis, const std::vector<Rational>& near,
               IntegerVector& X) {
  const size_t n = X.size();
  std::vector<std::vector<Rational>> orthogonal;
  std::vector<Rational> squares;
  for (const IntegerVector& vector : basis) {
    std::vector<Rational> rest(vector.begin(), vector.end());
    for (size_t j = 0; j < orthogonal.size(); ++j) {
      Rational along = 0;
      for (size_t i = 0; i < n; ++i) along += orthogonal[j][i] * Rational(vector[i]);
      along /= squares[j];
      for (size_t i = 0; i < n; ++i) rest[i] -= along * orthogonal[j][i];
    }
    Rational square = 0;
    for (const Rational& x : rest) square += x * x;
    orthogonal.push_back(std::move(rest));
    squares.push_back(square);
  }
  for (size_t j = basis.size(); j-- > 0;) {
    Rational along = 0;
    for (size_t i = 0; i < n; ++i) along += orthogonal[j][i] * (near[i] - Rational(X[i]));
    const Integer steps = nearest_integer(Rational(along / squares[j]));
    for (size_t i = 0; i < n; ++i) X[i] += steps * basis[j][i];
  }
}

}  // namespace

std::vector<IntegerVector> reduced_basis(std::vector<IntegerVector> basis) {
  return Reduction(std::move(basis)).run();
}

std::optional<IntegerVector> whole_solution(const RationalMatrix& A, const RationalMatrix& b,
                                            const std::vector<Rational>& near) {
  const auto rows = whole_rows(A, b);
  if (!rows) return std::nullopt;
  const size_t p = rows->size();
  const size_t n = near.size();
  // No vector of a kernel's basis is longer than the product of the rows' lengths.
  unsigned bits = static_cast<unsigned>(n) + 8;
  for (const IntegerVector& row : *rows) {
    Integer size = 1;
    for (size_t i = 0; i < n; ++i) size += abs(row[i]);
    bits += msb(size) + 2;
  }
  const Integer K = Integer(1) << bits;
  std::vector<IntegerVector> basis(n, IntegerVector(p + n, Integer(0)));
  for (size_t i = 0; i < n; ++i) {
    for (size_t r = 0; r < p; ++r) basis[i][r] = K * (*rows)[r][i];
    basis[i][p + i] = 1;
  }
  basis = reduced_basis(std::move(basis));
  std::vector<IntegerVector> kernel;
  std::vector<IntegerVector> others;
  RationalMatrix reached(static_cast<Eigen::Index>(p), static_cast<Eigen::Index>(p));
  for (const IntegerVector& vector : basis) {
    IntegerVector X(vector.begin() + static_cast<std::ptrdiff_t>(p), vector.end());
    if (std::all_of(vector.begin(), vector.begin() + static_cast<std::ptrdiff_t>(p),
                    [](const Integer& x) { return x == 0; })) {
      kernel.push_back(std::move(X));
      continue;
    }
    if (others.size() == p) return std::nullopt;
    for (size_t r = 0; r < p; ++r)
      reached(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(others.size())) =
          Rational(vector[r] / K);
    others.push_back(std::move(X));
  }
  if (others.size() != p) return std::nullopt;
  RationalMatrix right(static_cast<Eigen::Index>(p), 1);
  for (size_t r = 0; r < p; ++r) right(static_cast<Eigen::Index>(r)) = Rational((*rows)[r][n]);
  const auto steps = rational_solution(reached, right);
  if (!steps) return std::nullopt;
  IntegerVector X(n, Integer(0));
  for (size_t j = 0; j < p; ++j) {
    const Rational& step = (*steps)(static_cast<Eigen::Index>(j));
    if (denominator(step) != 1) return std::nullopt;
    for (size_t i = 0; i < n; ++i) X[i] += numerator(step) * others[j][i];
  }
  move_near(kernel, near, X);
  return X;
}

}  // namespace gainsmith::numbers
