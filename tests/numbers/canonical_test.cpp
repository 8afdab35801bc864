// orth and null: one basis for each subspace, in every precision, from every matrix that has it.
#include "numbers/dense/canonical.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>
#include <random>
#include <string>

#include "base/number.h"
#include "base/scalars.h"
#include "expr/binding/compile.h"
#include "expr/text/parser.h"
#include "numbers/types/enclosure.h"
#include "numbers/types/real.h"

namespace gainsmith::numbers {
namespace {

/// "orth(M)" or "null(M)", with a tolerance.
expr::Program program(const std::string& function, const Matrix& M) {
  Values values{{"M", M}};
  expr::Scope scope;
  scope.known = std::make_shared<KnownDoubles>(values);
  scope.symbols["M"] = {shape_of(M), true};
  return expr::compile(expr::parse({function + "(M, 1e-9)", "test"}), scope);
}

template <class S>
MatrixOf<S> basis(const std::string& function, const Matrix& M) {
  ValuesOf<S> values;
  values["M"] = M.template cast<S>();
  return evaluate<S>(program(function, M), values);
}

template <class S>
Enclosed<S> enclosed_basis(const std::string& function, const Matrix& M) {
  EnclosedValues<S> values;
  values["M"] = exactly<S>(MatrixOf<S>(M.template cast<S>()));
  return enclose<S>(program(function, M), values);
}

template <class S>
Matrix rounded(const MatrixOf<S>& M) {
  return M.unaryExpr([](const S& x) { return static_cast<double>(x); });
}

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}

  int between(int low, int high) { return std::uniform_int_distribution<int>(low, high)(engine_); }
  Matrix normal(int rows, int cols) {
    return Matrix::NullaryExpr(rows, cols, [&] { return std::normal_distribution<>()(engine_); });
  }
  /// Whole numbers: equal lengths, zeros and other coincidences are frequent.
  Matrix whole(int rows, int cols, int size) {
    return Matrix::NullaryExpr(rows, cols, [&] { return double(between(-size, size)); });
  }
  /// n x n of rank k, exactly.
  Matrix of_rank(int n, int k) { return whole(n, k, 2) * whole(k, n, 2); }

 private:
  std::mt19937_64 engine_;
};

/// The definition of canonical.h once more, from the projector on the range of M with k columns,
/// which is computed without singular values.
Matrix by_definition(Matrix W, int k) {
  Matrix B(W.rows(), k);
  for (int j = 0; j < k; ++j) {
    int p = 0;
    while (std::exp(1.0) * W(p, p) < W.diagonal().maxCoeff()) ++p;
    B.col(j) = W.col(p) / std::sqrt(W(p, p));
    W -= B.col(j) * B.col(j).transpose();
  }
  return B;
}

Matrix projector_of_range(const Matrix& M, int k) {
  const Eigen::ColPivHouseholderQR<Matrix> qr(M);
  const Matrix all = qr.householderQ();
  return all.leftCols(k) * all.leftCols(k).transpose();
}

class Canonical : public testing::TestWithParam<unsigned> {};

TEST_P(Canonical, IsTheBasisOfTheDefinition) {
  Random random(GetParam());
  for (int trial = 0; trial < 40; ++trial) {
    const int n = random.between(2, 7);
    const Matrix M = random.of_rank(n, random.between(1, n));
    const Matrix range = basis<double>("orth", M), kernel = basis<double>("null", M);
    const auto k = static_cast<int>(range.cols());
    ASSERT_EQ(kernel.cols(), n - k);
    const Matrix P = projector_of_range(M, k), Q = projector_of_range(M.transpose(), k);
    const Matrix rest = Matrix::Identity(n, n) - Q;
    EXPECT_LT((range - by_definition(P, k)).norm(), 1e-11) << M;
    EXPECT_LT((kernel - by_definition(rest, n - k)).norm(), 1e-11) << M;
    EXPECT_LT((range.transpose() * range - Matrix::Identity(k, k)).norm(), 1e-12) << M;
    EXPECT_LT((range * range.transpose() - P).norm(), 1e-11) << M;
    EXPECT_LT((kernel * kernel.transpose() - rest).norm(), 1e-11) << M;
  }
}

TEST_P(Canonical, IsTheSameInEveryPrecision) {
  Random random(GetParam());
  for (int trial = 0; trial < 20; ++trial) {
    const int n = random.between(2, 6);
    const Matrix M = random.of_rank(n, random.between(1, n));
    for (const char* function : {"orth", "null"}) {
      const auto found = basis<double>(function, M);
      const auto in_31 = basis<DoubleDouble>(function, M);
      const auto in_100 = basis<Decimal100>(function, M);
      EXPECT_LT((found - rounded(in_31)).norm(), 1e-12) << function << "\n" << M;
      EXPECT_LT((rounded(in_100) - rounded(in_31)).norm(), 1e-15) << function << "\n" << M;
      const auto bounded = enclosed_basis<double>(function, M);
      const auto sharp = enclosed_basis<Decimal100>(function, M);
      for (Eigen::Index i = 0; i < found.size(); ++i) {
        EXPECT_LE(std::abs(bounded.mid(i) - static_cast<double>(in_100(i))), bounded.rad(i));
        EXPECT_LE(static_cast<double>(abs(Decimal100(sharp.mid(i) - in_100(i)))),
                  sharp.rad(i) + 1e-85);
        EXPECT_LT(bounded.rad(i), 1e-9);
        EXPECT_LT(sharp.rad(i), 1e-80);
      }
    }
  }
}

TEST_P(Canonical, BelongsToTheSubspaceAlone) {
  Random random(GetParam());
  for (int trial = 0; trial < 40; ++trial) {
    const int n = random.between(2, 7);
    const Matrix M = random.of_rank(n, random.between(1, n));
    const auto k = static_cast<int>(basis<double>("orth", M).cols());
    if (k == 0) continue;
    const Matrix mixed = M * random.normal(n, n), turned = random.normal(n, n) * M;
    EXPECT_LT((basis<double>("orth", mixed) - basis<double>("orth", M)).norm(), 1e-7) << M;
    EXPECT_LT((basis<double>("null", turned) - basis<double>("null", M)).norm(), 1e-7) << M;
    // A change of the last digits, within the tolerance for the rank.
    const Matrix noise = 1e-13 * M.norm() * random.normal(n, n);
    EXPECT_LT((basis<double>("orth", M + noise) - basis<double>("orth", M)).norm(), 1e-8) << M;
    EXPECT_LT((basis<double>("null", M + noise) - basis<double>("null", M)).norm(), 1e-8) << M;
    // Units of all elements together, powers of two, change no bit.
    for (const double unit : {0x1p-40, 0x1p3})
      for (const char* function : {"orth", "null"})
        EXPECT_EQ(basis<double>(function, unit * M), basis<double>(function, M)) << M;
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, Canonical, testing::Values(1, 2, 3));

TEST(CanonicalBasis, OfCoordinatesIsThem) {
  Matrix M = Matrix::Zero(3, 4);
  M(0, 1) = 3;
  M(2, 1) = 1;
  M(2, 3) = 0.1;
  Matrix kernel = Matrix::Zero(4, 2), range = Matrix::Zero(3, 2);
  kernel(0, 0) = kernel(2, 1) = 1;
  range(0, 0) = range(2, 1) = 1;
  EXPECT_EQ(basis<double>("null", M), kernel);
  EXPECT_EQ(basis<double>("orth", M), range);
  EXPECT_TRUE(enclosed_basis<double>("null", M).is_exact());
  EXPECT_TRUE(enclosed_basis<double>("orth", M).is_exact());
  EXPECT_EQ(basis<double>("orth", Matrix(M.transpose() * M + Matrix::Identity(4, 4))),
            Matrix::Identity(4, 4));
}

TEST(CanonicalBasis, OfASubspaceThatDecimalsRoundIsKnownWithinItsRounding) {
  // A kernel of dimension 1 up to the tolerance only: exactly it is {0}.
  Matrix M(3, 3);
  M << 0.1, 0.2, 0.3, 0.7, 0.8, 0.9, 0.4, 0.5, 0.6;
  const auto N = enclosed_basis<Decimal100>("null", M);
  ASSERT_EQ(N.cols(), 1);
  EXPECT_LT(N.rad.maxCoeff(), 1e-80);
  EXPECT_LT((rounded(N.mid) - basis<double>("null", M)).norm(), 1e-14);
}

TEST(CanonicalBasis, PivotsThatNobodyKnowsGiveNoBasis) {
  using Wide = Ball<double>;
  const Columns<Wide> P = {{{0.5, 0.1}, {0.5, 0.1}}, {{0.5, 0.1}, {0.5, 0.1}}};
  EXPECT_TRUE(canonical::basis(P, 1, Wide{canonical::kLead, 0}).has_value());
  // e times 0.2689 is within the bounds of 0.731.
  const Columns<Wide> Q = {{{0.2689, 1e-3}, {0.4434, 1e-3}}, {{0.4434, 1e-3}, {0.7311, 1e-3}}};
  EXPECT_FALSE(canonical::basis(Q, 1, Wide{canonical::kLead, 0}).has_value());
}

}  // namespace
}  // namespace gainsmith::numbers
