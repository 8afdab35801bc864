// The projections satisfy what makes them projections, recomputed from the raw sets.
#include "numbers/projection.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "base/eigen_scalars.h"
#include "base/scalars.h"

namespace gainsmith::numbers {
namespace {

constexpr int kSets = 10000;
constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

class Draw {
 public:
  explicit Draw(unsigned seed) : random_(seed) {}

  int below(int count) { return std::uniform_int_distribution<int>(0, count - 1)(random_); }
  bool coin() { return below(2) == 0; }
  double number() { return std::uniform_real_distribution<double>(-1, 1)(random_); }
  Matrix matrix(Eigen::Index rows, Eigen::Index cols) {
    Matrix result(rows, cols);
    for (double& value : result.reshaped()) value = number();
    return result;
  }
  /// B diag B' with a condition of 1 to 1e8, in axes of its own or along the coordinates.
  Matrix definite(Eigen::Index n) {
    const double decades = below(9);
    Matrix B = Matrix::Identity(n, n);
    if (coin()) B = Eigen::HouseholderQR<Matrix>(matrix(n, n)).householderQ();
    Vector scale(n);
    for (double& value : scale) value = std::pow(10, decades * (number() - 1) / 2);
    const Matrix P = std::pow(10, below(7) - 3) * B * scale.asDiagonal() * B.transpose();
    return 0.5 * (P + P.transpose());
  }
  /// Rows with repeated, redundant, nearly parallel and dependent ones.
  Matrix rows(Eigen::Index m, Eigen::Index n) {
    Matrix A = matrix(m, n);
    for (Eigen::Index i = 1; i < m; ++i) {
      const Eigen::Index other = below(static_cast<int>(i));
      switch (below(6)) {
        case 0:
          A.row(i) = A.row(other);
          break;
        case 1:
          A.row(i) = A.row(other) + std::pow(10, -2 - below(7)) * matrix(1, n);
          break;
        case 2:
          A.row(i) = 0.5 * A.row(other) + 0.25 * A.row(below(static_cast<int>(i)));
          break;
        default:
          break;
      }
    }
    return A;
  }

 private:
  std::mt19937 random_;
};

/// epsilon (|M| |v|): what rounding v, or the product, changes M v by.
Vector unsure(const Matrix& M, const Matrix& v) { return kEpsilon * (M.cwiseAbs() * v.cwiseAbs()); }

double distance(const Matrix& P, const Matrix& a, const Matrix& b) {
  return std::sqrt(std::max(0.0, (a - b).col(0).dot((P * (a - b)).col(0))));
}

/// What rounding of a and b changes the distance by.
double blur(const Matrix& P, const Matrix& a, const Matrix& b) {
  return 8 * kEpsilon * std::sqrt(P.norm()) * (a.norm() + b.norm());
}

/// P (z - x) + gradient y = 0 to the rounding of z and y.
void expect_stationary(const Matrix& P, const Matrix& x, const Projection<double>& found,
                       const Matrix& gradient) {
  const Vector rest = P * (found.point - x) + gradient * found.multipliers;
  const Vector most = unsure(P, found.point) + unsure(P, x) + unsure(gradient, found.multipliers);
  for (Eigen::Index i = 0; i < rest.size(); ++i) EXPECT_LE(std::abs(rest(i)), 20 * most(i));
}

struct RandomSet {
  Matrix P, A, b, inside, x;
};

/// A polytope with `inside` in it, often at a vertex where many rows meet, and x anywhere.
RandomSet polytope(Draw& draw) {
  RandomSet set;
  const Eigen::Index n = 1 + draw.below(8), m = 1 + draw.below(3 * static_cast<int>(n) + 2);
  set.P = draw.definite(n);
  set.A = draw.rows(m, n);
  set.inside = draw.matrix(n, 1);
  set.x = set.inside + std::pow(10, draw.below(5) - 2) * draw.matrix(n, 1);
  if (draw.coin()) {
    // Whole numbers, among them many zeros: rows meet exactly, on axes and at the origin, and pairs
    // of them are equations.
    set.A = (1.4 * set.A).array().round();
    set.inside = (1.4 * set.inside).array().round();
    for (Eigen::Index i = 1; i < m; ++i)
      if (draw.below(4) == 0) set.A.row(i) = -set.A.row(i - 1);
    set.b = set.A * set.inside;
    for (double& value : set.b.reshaped()) value += draw.below(5) == 0;
    return set;
  }
  set.b = set.A * set.inside;
  for (double& value : set.b.reshaped())
    if (draw.coin()) value += std::abs(draw.number());
  // What rounding took away at a vertex.
  set.b.col(0) += 2 * static_cast<double>(n) * unsure(set.A, set.inside);
  return set;
}

TEST(ProjectPolytope, IsStationaryFeasibleAndComplementary) {
  Draw draw(1);
  for (int k = 0; k < kSets && !testing::Test::HasFailure(); ++k) {
    SCOPED_TRACE(k);
    const auto [P, A, b, inside, x] = polytope(draw);
    const auto found = project_polytope<double>(x, P, A, b);
    expect_stationary(P, x, found, A.transpose());
    const Vector rest = A * found.point - b;
    const Vector most = unsure(A, found.point) + kEpsilon * b.cwiseAbs();
    for (Eigen::Index i = 0; i < rest.size(); ++i) {
      EXPECT_LE(rest(i), 3 * most(i)) << "row " << i;
      EXPECT_GE(found.multipliers(i), 0) << "row " << i;
      if (found.multipliers(i) == 0) continue;
      EXPECT_GE(rest(i), -3 * most(i)) << "row " << i;
    }
  }
}

TEST(ProjectPolytope, ProjectsOnceAndExpandsNothing) {
  Draw draw(2);
  for (int k = 0; k < kSets && !testing::Test::HasFailure(); ++k) {
    SCOPED_TRACE(k);
    const auto [P, A, b, inside, x] = polytope(draw);
    const Matrix z = project_polytope<double>(x, P, A, b).point;
    EXPECT_EQ(project_polytope<double>(z, P, A, b).point, z);
    EXPECT_EQ(project_polytope<double>(inside, P, A, b).point, inside);
    const Matrix other = x + draw.matrix(x.rows(), 1);
    const Matrix there = project_polytope<double>(other, P, A, b).point;
    EXPECT_LE(distance(P, z, there), distance(P, x, other) + blur(P, z, there));
    EXPECT_LE(distance(P, z, inside), distance(P, x, inside) + blur(P, z, inside));
  }
}

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

TEST(ProjectPolytope, AnEmptyOneIsRefused) {
  Draw draw(4);
  for (int k = 0; k < 2000; ++k) {
    SCOPED_TRACE(k);
    auto [P, A, b, inside, x] = polytope(draw);
    // A positive combination of rows below what the rows allow.
    const Eigen::Index m = A.rows(), n = A.cols();
    const Matrix weights = draw.matrix(1, m).cwiseAbs();
    const Matrix combined = -(weights * A);
    Matrix more(m + 1, n), right(m + 1, 1);
    more << A, combined;
    right << b, -(weights * b) - Matrix::Constant(1, 1, 1e-3);
    EXPECT_THROW(project_polytope<double>(x, P, more, right), NoProjection);
  }
}

TEST(ProjectPolytope, OfASegmentGivenAsEqualities) {
  // A slab without thickness, and rows that repeat it in other units.
  const Matrix A{{1, 1}, {-1, -1}, {2, 2}, {-0.1, -0.1}, {1, 0}};
  const Matrix b{{1}, {-1}, {2}, {-0.1}, {0.25}};
  const Matrix z = project_polytope<double>(Matrix{{3}, {1}}, Matrix::Identity(2, 2), A, b).point;
  EXPECT_EQ(z, (Matrix{{0.25}, {0.75}}));
}

struct RandomEllipsoid {
  Matrix P, x0, Q, r, x;
};

RandomEllipsoid ellipsoid(Draw& draw) {
  const Eigen::Index n = 1 + draw.below(8);
  RandomEllipsoid set{draw.definite(n), draw.matrix(n, 1), draw.definite(n), {}, {}};
  if (draw.below(3) == 0) {
    // On a grid, so that G'G is semidefinite in every arithmetic.
    const Matrix G =
        (draw.matrix(1 + draw.below(static_cast<int>(n)), n) * 1024).array().round() / 1024;
    set.Q = G.transpose() * G;
  }
  set.r = Matrix::Constant(1, 1, std::pow(10, draw.below(5) - 2) * set.Q.norm());
  set.x = set.x0 + std::pow(10, draw.below(5) - 2) * draw.matrix(n, 1);
  return set;
}

double form(const Matrix& Q, const Matrix& v) { return v.col(0).dot((Q * v).col(0)); }
/// What the rounding of z changes the form by.
double form_blur(const RandomEllipsoid& set, const Matrix& z) {
  const Matrix from = (z - set.x0).cwiseAbs(), size = z.cwiseAbs() + set.x0.cwiseAbs();
  return 8 * kEpsilon * (2 * from + kEpsilon * size).col(0).dot((set.Q.cwiseAbs() * size).col(0));
}

TEST(ProjectEllipsoid, IsStationaryFeasibleAndComplementary) {
  Draw draw(5);
  int outside = 0;
  for (int k = 0; k < kSets && !testing::Test::HasFailure(); ++k) {
    SCOPED_TRACE(k);
    const RandomEllipsoid set = ellipsoid(draw);
    const auto found = project_ellipsoid<double>(set.x, set.P, set.x0, set.Q, set.r);
    const double y = found.multipliers(0);
    const Vector rest = set.P * (found.point - set.x) + y * set.Q * (found.point - set.x0);
    const Vector most = unsure(set.P, found.point) + unsure(set.P, set.x) +
                        y * (unsure(set.Q, found.point) + unsure(set.Q, set.x0));
    for (Eigen::Index i = 0; i < rest.size(); ++i) EXPECT_LE(std::abs(rest(i)), 20 * most(i));
    const double level = form(set.Q, found.point - set.x0);
    const double blurred = form_blur(set, found.point) + 8 * kEpsilon * set.r(0);
    EXPECT_LE(level, set.r(0) + blurred);
    EXPECT_GE(y, 0);
    if (y == 0) continue;
    EXPECT_GE(level, set.r(0) - blurred);
    ++outside;
  }
  EXPECT_GT(outside, kSets / 5);
}

TEST(ProjectEllipsoid, ProjectsOnceAndExpandsNothing) {
  Draw draw(6);
  for (int k = 0; k < kSets && !testing::Test::HasFailure(); ++k) {
    SCOPED_TRACE(k);
    const RandomEllipsoid set = ellipsoid(draw);
    const auto project = [&](const Matrix& x) {
      return project_ellipsoid<double>(x, set.P, set.x0, set.Q, set.r).point;
    };
    const Matrix z = project(set.x);
    EXPECT_EQ(project(z), z);
    EXPECT_EQ(project(set.x0), set.x0);
    const Matrix other = set.x + draw.matrix(set.x.rows(), 1), there = project(other);
    EXPECT_LE(distance(set.P, z, there), distance(set.P, set.x, other) + blur(set.P, z, there));
  }
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

struct RandomFlat {
  Matrix P, A, b, x;
};

/// A z = b with a solution, also where rows are repeated, nearly parallel or combinations.
RandomFlat flat(Draw& draw) {
  const Eigen::Index n = 1 + draw.below(8), m = 1 + draw.below(static_cast<int>(n) + 2);
  RandomFlat set{draw.definite(n), draw.rows(m, n), {}, {}};
  // On grids, so that the planted solution is one exactly.
  set.A = (set.A * 0x1p20).array().round() * 0x1p-20;
  const Matrix planted = (draw.matrix(n, 1) * 0x1p20).array().round() * 0x1p-20;
  set.b = set.A * planted;
  set.x = planted + std::pow(10, draw.below(5) - 2) * draw.matrix(n, 1);
  return set;
}

TEST(ProjectAffine, IsStationaryAndFeasible) {
  Draw draw(7);
  for (int k = 0; k < kSets && !testing::Test::HasFailure(); ++k) {
    SCOPED_TRACE(k);
    const auto [P, A, b, x] = flat(draw);
    const auto found = project_affine<double>(x, P, A, b);
    expect_stationary(P, x, found, A.transpose());
    const Vector rest = A * found.point - b;
    const Vector most = unsure(A, found.point) + kEpsilon * b.cwiseAbs();
    for (Eigen::Index i = 0; i < rest.size(); ++i) EXPECT_LE(std::abs(rest(i)), 4 * most(i));
  }
}

TEST(ProjectAffine, ProjectsOnceAndExpandsNothing) {
  Draw draw(8);
  for (int k = 0; k < kSets && !testing::Test::HasFailure(); ++k) {
    SCOPED_TRACE(k);
    const auto [P, A, b, x] = flat(draw);
    const Matrix z = project_affine<double>(x, P, A, b).point;
    EXPECT_EQ(project_affine<double>(z, P, A, b).point, z);
    const Matrix other = x + draw.matrix(x.rows(), 1);
    const Matrix there = project_affine<double>(other, P, A, b).point;
    EXPECT_LE(distance(P, z, there), distance(P, x, other) + blur(P, z, there));
  }
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
}  // namespace gainsmith::numbers
