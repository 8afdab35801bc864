// The solver's parts, each against the formula that its header states.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <type_traits>
#include <vector>

#include "sdp/core/extreme.h"
#include "sdp/core/presolve.h"
#include "sdp/schur/cover.h"
#include "sdp/schur/factor.h"
#include "sdp/schur/kernels.h"
#include "sdp/schur/schur.h"
#include "support/linear_algebra.h"

namespace gainsmith::sdp {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using tests::widened;

MatrixXd varied(int rows, int columns, double phase) {
  MatrixXd m(rows, columns);
  for (int j = 0; j < columns; ++j)
    for (int i = 0; i < rows; ++i) m(i, j) = std::sin(phase + 1.3 * i + 2.7 * j + 0.1 * i * j);
  return m;
}

MatrixXd positive(int n, double phase) {
  const MatrixXd a = varied(n, n, phase);
  const MatrixXd square = tests::product({a, a.transpose()});
  return 0.5 * (square + square.transpose()) + MatrixXd::Identity(n, n);
}

template <typename T>
class Kernels : public ::testing::Test {
 protected:
  /// Relative error that sums of a hundred terms may have.
  static double tolerance() { return 1e3 * static_cast<double>(std::numeric_limits<T>::epsilon()); }
  static double norm(const Matrix<T>& m) {
    double largest = 0;
    for (Eigen::Index k = 0; k < m.size(); ++k)
      largest = std::max(largest, std::abs(static_cast<double>(m.data()[k])));
    return largest;
  }
};

using Scalars = ::testing::Types<double, DoubleDouble, Decimal100>;
TYPED_TEST_SUITE(Kernels, Scalars);

TYPED_TEST(Kernels, ProductsAgreeWithTheDefinition) {
  using T = TypeParam;
  const Matrix<T> a = widened<T>(varied(13, 9, 1)), b = widened<T>(varied(9, 7, 2));
  Matrix<T> c = Matrix<T>::Zero(13, 7);
  multiply(View<const T>(a), View<const T>(b), View<T>(c));
  for (int j = 0; j < 7; ++j)
    for (int i = 0; i < 13; ++i) {
      for (int k = 0; k < 9; ++k) c(i, j) -= a(i, k) * b(k, j);
    }
  EXPECT_LT(this->norm(c), this->tolerance());
  multiply(View<const T>(a), View<const T>(b), View<T>(c), Update::subtract);
  multiply(View<const T>(a), View<const T>(Matrix<T>(-b)), View<T>(c), Update::subtract);
  EXPECT_LT(this->norm(c), this->tolerance());
}

/// Shapes around the widths of registers, tiles and panels.
TYPED_TEST(Kernels, ProductsOfAllShapesAgreeWithTheDefinition) {
  using T = TypeParam;
  const bool narrow = !std::is_same_v<T, Decimal100>;
  for (const int rows : {1, 7, 8, 17, 24, 33, 250})
    for (const int columns : {1, 3, 6, 11, 40})
      for (const int inner : {0, 1, 5, 32, 300}) {
        if (!narrow && rows * columns * inner > 5000) continue;
        const Matrix<T> a = widened<T>(varied(rows, inner, 1)),
                        b = widened<T>(varied(inner, columns, 2));
        Matrix<T> c = widened<T>(varied(rows, columns, 3));
        const double tolerance = (1 + inner) * this->tolerance();
        const Matrix<T> before = c, expected = a.lazyProduct(b);
        multiply(View<const T>(a), View<const T>(b), View<T>(c), Update::subtract);
        EXPECT_LT(this->norm(c + expected - before), tolerance) << rows << columns << inner;
        multiply(View<const T>(a), View<const T>(b), View<T>(c));
        EXPECT_LT(this->norm(c - expected), tolerance) << rows << columns << inner;
      }
}

TYPED_TEST(Kernels, TriangularProductsAreProducts) {
  using T = TypeParam;
  for (const int n : {1, 9, 50}) {
    const Matrix<T> a = widened<T>(varied(n, n, 1)), full = widened<T>(varied(n, n, 2));
    const Matrix<T> upper = full.template triangularView<Eigen::Upper>();
    const Matrix<T> lower = full.template triangularView<Eigen::Lower>();
    Matrix<T> c(n, n);
    multiply_upper(View<const T>(a), View<const T>(upper), View<T>(c));
    EXPECT_LT(this->norm(c - a.lazyProduct(upper)), n * this->tolerance());
    multiply_lower(View<const T>(a), View<const T>(lower), View<T>(c));
    EXPECT_LT(this->norm(c - a.lazyProduct(lower)), n * this->tolerance());
  }
}

TYPED_TEST(Kernels, CholeskyFactorsInverts) {
  using T = TypeParam;
  constexpr int n = 70;  // three panels
  const Matrix<T> a = widened<T>(positive(n, 3));
  Matrix<T> l = a, inverse(n, n);
  ASSERT_TRUE(cholesky(View<T>(l)));
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < j; ++i) l(i, j) = T(0);
  Matrix<T> product(n, n);
  multiply(View<const T>(l), View<const T>(Matrix<T>(l.transpose())), View<T>(product));
  EXPECT_LT(this->norm(product - a), this->tolerance() * this->norm(a));

  invert_lower(View<const T>(l), View<T>(inverse));
  multiply(View<const T>(inverse), View<const T>(l), View<T>(product));
  EXPECT_LT(this->norm(product - Matrix<T>::Identity(n, n)), this->tolerance());

  Vector<T> x = a.col(0);
  solve_factored(View<const T>(l), x);
  x[0] -= T(1);
  EXPECT_LT(this->norm(x), this->tolerance() * 10);
}

// Its outer panels, and those that the zeros leave out.
TEST(LargeKernels, CholeskyFactorsALargeMatrixWithAZeroBlock) {
  constexpr int n = 700, first = 250, second = 250;
  MatrixXd a = positive(n, 3);
  a.block(first, 0, second, first).setZero();
  a.block(0, first, first, second).setZero();
  a.diagonal().array() += a.cwiseAbs().rowwise().sum().maxCoeff();
  MatrixXd l = a;
  ASSERT_TRUE(cholesky(View<double>(l)));
  l.triangularView<Eigen::StrictlyUpper>().setZero();
  EXPECT_EQ(l.block(first, 0, second, first).norm(), 0);
  EXPECT_LT((l * l.transpose() - a).norm(), 1e-13 * a.norm());
}

TYPED_TEST(Kernels, CholeskyRefusesWhatIsNotPositive) {
  using T = TypeParam;
  Matrix<T> a = widened<T>(positive(40, 3));
  a(37, 37) = T(-1);
  EXPECT_FALSE(cholesky(View<T>(a)));
}

TEST(Tridiagonal, BoundsTheSmallestEigenvalueFromBelow) {
  for (const int n : {2, 7, 40}) {
    const VectorXd diagonal = varied(n, 1, 1).col(0), subdiagonal = varied(n - 1, 1, 2).col(0);
    MatrixXd t = diagonal.asDiagonal();
    t.diagonal(1) = t.diagonal(-1) = subdiagonal;
    const double exact = tests::symmetric_eigenvalues(t)[0];
    const double bound = smallest_of_tridiagonal(diagonal, subdiagonal, -1e-3);
    EXPECT_LE(bound, exact + 1e-12);
    EXPECT_GT(bound, 1.002 * exact);
    EXPECT_EQ(smallest_of_tridiagonal(diagonal, subdiagonal, 2 * exact), 2 * exact);
  }
}

TEST(Lanczos, BoundsTheSmallestEigenvalueFromBelow) {
  for (const int n : {33, 60, 90}) {
    const MatrixXd v = positive(n, n), d = varied(n, n, 5) + varied(n, n, 5).transpose();
    MatrixXd l = tests::cholesky_factor(v);
    const MatrixXd inverse = tests::inverse(l);
    const MatrixXd w = tests::product({inverse, d, inverse.transpose()});
    const double exact = tests::symmetric_eigenvalues(w)[0];
    Lanczos lanczos(n);
    bool converged = false;
    const double bound = lanczos.lower_bound(l, d, -1e-3, converged);
    EXPECT_TRUE(converged);
    EXPECT_LE(bound, exact + 1e-10);
    EXPECT_GT(bound, 1.03 * exact);
  }
}

TEST(ConeFactor, DividesByItsMatrix) {
  const Layout layout({40, 3}, 0);
  Blocks<double> v(layout);
  for (int b = 0; b < 2; ++b) v.dense(b) = positive(layout.size[static_cast<std::size_t>(b)], 1);
  ConeFactor<double> factor(layout);
  ASSERT_TRUE(factor.factorise(v));
  for (int b = 0; b < 2; ++b) {
    const Eigen::Index n = v.dense(b).rows();
    const MatrixXd m = varied(static_cast<int>(n), static_cast<int>(n), 2);
    MatrixXd quotient = m, work(n, n);
    factor.divide(b, View<double>(quotient), View<double>(work));
    EXPECT_LT((tests::product({quotient, v.dense(b)}) - m).norm(), 1e-9);
  }
}

TEST(ConeFactor, StepsToTheBoundary) {
  for (const int n : {6, 50}) {
    const Layout layout({n}, 2);
    Blocks<double> v(layout), d(layout);
    v.dense(0) = positive(n, 1);
    d.dense(0) = -10 * positive(n, 2);
    v.linear() << 1, 2;
    d.linear() << 1, -1e-3;
    ConeFactor<double> cone(layout);
    ASSERT_TRUE(cone.factorise(v));
    const double a = cone.step(d, 10);
    const auto smallest = [&](double step) {
      const MatrixXd moved = v.dense(0) + step * d.dense(0);
      return tests::symmetric_eigenvalues(moved)[0];
    };
    EXPECT_GE(smallest(0.999 * a), 0);
    EXPECT_LT(smallest(1.03 * a), 0);
    Blocks<double> inverse(layout);
    cone.inverse(inverse);
    const MatrixXd one = tests::product({inverse.dense(0), v.dense(0)});
    EXPECT_LT((one - MatrixXd::Identity(n, n)).norm(), 1e-9);
    v.linear()[1] = 0;
    EXPECT_FALSE(cone.factorise(v));
  }
}

/// Lists of every kind: full matrices, a few rows, single entries; and a linear part.
Data mixed_data(int n, int m) {
  Data data;
  data.layout = Layout({n}, 3);
  BlockData& block = data.dense.emplace_back();
  for (int i = 1; i <= m; ++i) {
    data.c.push_back(1);
    data.c_rest.push_back(0);
    block.constraint.push_back(i);
    const MatrixXd f = varied(n, n, i);
    for (int q = 0; q < n; ++q)
      for (int p = 0; p <= q; ++p) {
        const bool single = p == (i * 3) % n && q >= p && q <= p + 1;
        if (i % 3 == 0 ? single : (i % 3 == 1 || p == i % n || q == i % n))
          block.terms.push_back({p, q, f(p, q), 0});
      }
    block.start.push_back(block.terms.size());
    data.linear.constraint.push_back(i);
    data.linear.terms.push_back({i % 3, i % 3, 0.5 + i, 0});
    data.linear.start.push_back(data.linear.terms.size());
  }
  return data;
}

TYPED_TEST(Kernels, ApplyIsTheTransposeOfAdjoint) {
  using T = TypeParam;
  Data data = mixed_data(19, 11);
  for (Term& term : data.dense[0].terms) term.rest = 0x1p-60 * term.value;
  Blocks<T> image(data.layout), s(data.layout);
  const Vector<T> x = varied(11, 1, 6).col(0).cast<T>();
  const T tau = T(0.7);
  adjoint(data, x, tau, image);
  s.dense(0) = widened<T>(positive(19, 5));
  s.linear() << T(3), T(-1), T(2);
  Vector<T> products(11);
  const T with_f0 = apply(data, s, products);
  const T difference = inner(image, s) - x.dot(products) + tau * with_f0;
  EXPECT_LT(std::abs(static_cast<double>(difference)), 100 * this->tolerance());
}

TEST(Schur, SolvesWithTheMatrixOfItsDefinition) {
  for (const auto& [n, m] : {std::pair{5, 9}, std::pair{24, 31}}) {
    const Data data = mixed_data(n, m);
    Blocks<double> X(data.layout), Y(data.layout);
    X.dense(0) = tests::inverse(positive(n, 1));
    Y.dense(0) = positive(n, 2);
    X.linear() << 1, 2, 3;
    Y.linear() << 3, 1, 2;

    MatrixXd b(m, m);
    Vector<double> column(m);
    Blocks<double> f(data.layout), image(data.layout);
    for (int j = 0; j < m; ++j) {
      adjoint(data, Vector<double>(VectorXd::Unit(m, j)), 0.0, f);
      const MatrixXd u = tests::product({X.dense(0), f.dense(0), Y.dense(0)});
      image.dense(0) = 0.5 * (u + u.transpose());
      image.linear() = X.linear().cwiseProduct(f.linear()).cwiseProduct(Y.linear());
      apply(data, image, column);
      b.col(j) = column;
    }
    for (const unsigned threads : {1U, 2U}) {
      Schur<double> schur(data, threads);
      schur.assemble(X, Y);
      ASSERT_TRUE(schur.factorise());
      const Vector<double> expected = varied(m, 1, 4).col(0);
      Vector<double> x(m);
      schur.solve(b * expected, x);
      EXPECT_LT((b * (x - expected)).norm(), 1e-9 * (b * expected).norm());
    }
  }
}

TEST(Cover, HoldsEveryEntry) {
  // A row and a column, an entry on the diagonal, one elsewhere.
  std::vector<Term> terms;
  for (int k = 0; k < 20; ++k) terms.push_back({std::min(k, 7), std::max(k, 7), 1, 0});
  terms.push_back({3, 3, 1, 0});
  terms.push_back({11, 15, 1, 0});
  const Cover cover = cover_of(terms.data(), terms.data() + terms.size(), 20);
  ASSERT_TRUE(cover.found);
  EXPECT_EQ(cover.rows, (std::vector<int>{7, 3, 11}));
  ASSERT_EQ(cover.slot.size(), terms.size());
  for (std::size_t t = 0; t < terms.size(); ++t) {
    const int row = cover.rows[static_cast<std::size_t>(cover.slot[t])];
    EXPECT_TRUE(terms[t].row == row || terms[t].column == row);
  }
}

TEST(Cover, GivesUpOnFullMatrices) {
  std::vector<Term> terms;
  for (int j = 0; j < 8; ++j)
    for (int i = 0; i <= j; ++i) terms.push_back({i, j, 1, 0});
  EXPECT_FALSE(cover_of(terms.data(), terms.data() + terms.size(), 8).found);
}

TEST(Presolve, SplitsComponentsAndPutsThemBack) {
  // Rows 0 and 2 belong together, 1 stands alone, 3 never occurs.
  Problem problem;
  problem.blocks = {{4, false}};
  problem.c = {4, 0, 2};
  problem.f = {{{0, 0, 2, 3}}, {{0, 0, 0, 8}, {0, 2, 2, 1}}, {}, {{0, 1, 1, 0.5}}};
  const Presolved presolved = presolve(problem);
  EXPECT_EQ(presolved.data.layout.size, (std::vector<int>{2}));
  EXPECT_EQ(presolved.data.layout.linear, 1);
  EXPECT_EQ(presolved.recovery.constraint, (std::vector<int>{0, 2}));
  EXPECT_EQ(presolved.free_descent, -1);

  Vector<double> x(2);
  x << 1, 2;
  Blocks<double> X(presolved.data.layout), Y(presolved.data.layout);
  adjoint(presolved.data, x, 1.0, X);
  const Point<double> point = restore<double>(problem, presolved, x, X, Y, 1.0);
  EXPECT_EQ(point.x[1], 0);
  EXPECT_EQ(point.X[0][0], 8 * point.x[0]);
  EXPECT_EQ(point.X[0][2], -3);
  EXPECT_EQ(point.X[0][8], -3);
  EXPECT_EQ(point.X[0][5], 0.5 * point.x[2]);
  EXPECT_EQ(point.X[0][15], 0);
}

}  // namespace
}  // namespace gainsmith::sdp
