// Projections with known answers, in more digits, and without an answer.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <functional>
#include <string>

#include "base/eigen_scalars.h"
#include "base/scalars.h"
#include "numerics/projection.h"
#include "numerics/random_sets.h"

namespace gainsmith::numerics {
namespace {

/// Of the coordinates one after the other: the box and the diagonal metric are known by hand.
TEST(ProjectPolytope, OfABoxIsTheClip) {
  Draw draw(3);
  for (int k = 0; k < 1000; ++k) {
    const Eigen::Index n = 1 + draw.below(8);
    Matrix A(2 * n, n), b(2 * n, 1);
    A << Matrix::Identity(n, n), -Matrix::Identity(n, n);
    b.setConstant(0.5);
    Matrix P = Matrix::Zero(n, n);
    for (Eigen::Index i = 0; i < n; ++i) P(i, i) = std::pow(10, 8 * draw.number());
    const Matrix x = 2 * draw.matrix(n, 1);
    EXPECT_EQ(project_polytope<double>(x, P, A, b).point, Matrix(x.cwiseMax(-0.5).cwiseMin(0.5)));
  }
}

TEST(ProjectPolytope, OfASegmentGivenAsEqualities) {
  // A slab without thickness, and rows that repeat it in other units.
  const Matrix A{{1, 1}, {-1, -1}, {2, 2}, {-0.1, -0.1}, {1, 0}};
  const Matrix b{{1}, {-1}, {2}, {-0.1}, {0.25}};
  const Matrix z = project_polytope<double>(Matrix{{3}, {1}}, Matrix::Identity(2, 2), A, b).point;
  EXPECT_EQ(z, (Matrix{{0.25}, {0.75}}));
}

TEST(ProjectEllipsoid, OfABallALevelAndAPoint) {
  const Matrix I = Matrix::Identity(2, 2), zero = Matrix::Zero(2, 1);
  const Matrix x{{6}, {8}};
  const auto level = [](double r) { return Matrix::Constant(1, 1, r); };
  EXPECT_EQ(project_ellipsoid<double>(x, I, zero, I, level(25)).point, (Matrix{{3}, {4}}));
  EXPECT_EQ(project_ellipsoid<double>(x, I, zero, I, level(0)).point, zero);
  EXPECT_EQ(project_ellipsoid<double>(x, I, zero, Matrix{{1, 0}, {0, 0}}, level(0)).point,
            (Matrix{{0}, {8}}));
  EXPECT_EQ(project_ellipsoid<double>(x, I, zero, Matrix{{1, 0}, {0, 0}}, level(4)).point,
            (Matrix{{2}, {8}}));
  EXPECT_EQ(project_ellipsoid<double>(x, I, zero, Matrix::Zero(2, 2), level(0)).point, x);
  // In a metric whose root is not a decimal.
  const Matrix P{{0.3, 0.1}, {0.1, 0.7}};
  EXPECT_EQ(project_ellipsoid<double>(x, P, zero, I, level(0)).point, zero);
  EXPECT_EQ(project_ellipsoid<double>(x, P, zero, Matrix{{1, 0}, {0, 0}}, level(0)).point(0), 0);
}

TEST(ProjectAffine, TellsRedundantFromContradicting) {
  const Matrix I = Matrix::Identity(2, 2), x{{3}, {1}};
  const Matrix A{{0.1, 0.1}, {0.3, 0.3}, {0, 0}};
  const Matrix z = project_affine<double>(x, I, A, Matrix{{0.2}, {0.6}, {0}}).point;
  EXPECT_LE((z - Matrix{{2}, {0}}).norm(), 1e-15);
  EXPECT_THROW(project_affine<double>(x, I, A, Matrix{{0.2}, {0.6 + 1e-12}, {0}}), NoProjection);
  EXPECT_THROW(project_affine<double>(x, I, A, Matrix{{0.2}, {0.6}, {1e-300}}), NoProjection);
}

/// The same text in more digits, rounded, is the result in fewer.
template <class Scalar>
class WideProjections : public testing::Test {};
using Scalars = testing::Types<DoubleDouble, Decimal100>;
TYPED_TEST_SUITE(WideProjections, Scalars);

TYPED_TEST(WideProjections, RoundToThoseInDouble) {
  const auto widened = [](const Matrix& M) -> MatrixOf<TypeParam> { return M.cast<TypeParam>(); };
  const auto expect_rounded = [](const Projection<TypeParam>& wide, const Matrix& z) {
    const Matrix rounded =
        wide.point.unaryExpr([](const TypeParam& v) { return static_cast<double>(v); });
    EXPECT_LE((rounded - z).cwiseAbs().maxCoeff(), 1e-9 * (1 + z.norm()));
  };
  Draw draw(9);
  for (int k = 0; k < 100; ++k) {
    SCOPED_TRACE(k);
    const RandomSet set = polytope(draw);
    const auto x = widened(set.x), P = widened(set.P), A = widened(set.A), b = widened(set.b);
    expect_rounded(project_polytope<TypeParam>(x, P, A, b),
                   project_polytope<double>(set.x, set.P, set.A, set.b).point);
    const RandomEllipsoid other = ellipsoid(draw);
    expect_rounded(
        project_ellipsoid<TypeParam>(widened(other.x), widened(other.P), widened(other.x0),
                                     widened(other.Q), widened(other.r)),
        project_ellipsoid<double>(other.x, other.P, other.x0, other.Q, other.r).point);
  }
}

TYPED_TEST(WideProjections, KeepTheirDigits) {
  const MatrixOf<TypeParam> x = MatrixOf<TypeParam>::Constant(2, 1, TypeParam(3));
  const MatrixOf<TypeParam> P = MatrixOf<TypeParam>::Identity(2, 2);
  const MatrixOf<TypeParam> zero = MatrixOf<TypeParam>::Zero(2, 1);
  const auto one = MatrixOf<TypeParam>::Constant(1, 1, TypeParam(1));
  const auto z = project_ellipsoid<TypeParam>(x, P, zero, P, one).point;
  const TypeParam rest = z(0) * z(0) * TypeParam(2) - TypeParam(1);
  EXPECT_LE(std::abs(static_cast<double>(rest)), sizeof(TypeParam) > 16 ? 1e-97 : 1e-29);
}

std::string why(const std::function<void()>& project) {
  try {
    project();
  } catch (const NoProjection& error) {
    return error.what();
  }
  return "";
}

TEST(Projections, WithoutAResultSayWhy) {
  const Matrix x{{2}, {2}}, I = Matrix::Identity(2, 2), b{{1}, {1}}, one = Matrix::Ones(1, 1);
  for (const Matrix& P : {Matrix{{1, 2}, {2, 1}}, Matrix{{1, 1}, {1, 1}}, Matrix{{0, 0}, {0, 1}},
                          Matrix{{-1, 0}, {0, 1}}, Matrix{{1e-8, 1}, {1, 1e8}}}) {
    EXPECT_EQ(why([&] { project_polytope<double>(x, P, I, b); }), "P is not positive definite");
    EXPECT_EQ(why([&] { project_affine<double>(x, P, I, b); }), "P is not positive definite");
    EXPECT_EQ(why([&] { project_ellipsoid<double>(x, P, b, I, one); }),
              "P is not positive definite");
  }
  EXPECT_EQ(why([&] {
              project_polytope<double>(b, Matrix{{1, 2}, {2, 1}}, I, x);
            }),
            "P is not positive definite");  // also where x is inside
  EXPECT_EQ(why([&] {
              project_polytope<double>(x, I, Matrix{{1, 0}, {-1, 0}}, Matrix{{1}, {-2}});
            }),
            "the polytope is empty");
  EXPECT_EQ(why([&] {
              project_polytope<double>(x, I, Matrix::Zero(2, 2), Matrix{{1}, {-1}});
            }),
            "the polytope is empty");
  EXPECT_EQ(why([&] {
              project_affine<double>(x, I, Matrix::Ones(2, 2), Matrix{{1}, {2}});
            }),
            "the affine set is empty");
  EXPECT_EQ(why([&] {
              project_ellipsoid<double>(x, I, b, Matrix{{1, 0}, {0, -1}}, one);
            }),
            "Q is not positive semidefinite");
  EXPECT_EQ(why([&] { project_ellipsoid<double>(x, I, b, I, -one); }),
            "the ellipsoid is empty: r is negative");
}

TEST(Projections, OfEmptyMatricesAndWithoutRows) {
  const Matrix x{{2}, {2}}, I = Matrix::Identity(2, 2);
  EXPECT_EQ(project_polytope<double>(x, I, Matrix(0, 2), Matrix(0, 1)).point, x);
  EXPECT_EQ(project_affine<double>(x, I, Matrix(0, 2), Matrix(0, 1)).point, x);
  const Matrix none(0, 1), nothing(0, 0);
  EXPECT_EQ(project_polytope<double>(none, nothing, Matrix(1, 0), Matrix::Ones(1, 1)).point.size(),
            0);
  EXPECT_EQ(project_ellipsoid<double>(none, nothing, none, nothing, Matrix(Matrix::Ones(1, 1)))
                .point.size(),
            0);
}

TEST(Projections, OnlyTheSymmetricPartOfTheMetricCounts) {
  const Matrix x{{3}, {1}}, P{{2, 1}, {0, 1}}, A{{1, 2}}, b{{1}};
  EXPECT_EQ(project_polytope<double>(x, P, A, b).point,
            project_polytope<double>(x, Matrix{{2, 0.5}, {0.5, 1}}, A, b).point);
}

}  // namespace
}  // namespace gainsmith::numerics
