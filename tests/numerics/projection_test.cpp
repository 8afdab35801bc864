// The projections satisfy what makes them projections, recomputed from the raw sets.
#include "numerics/projection.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "numerics/random_sets.h"

namespace gainsmith::numerics {
namespace {

constexpr int kSets = 10000;

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

}  // namespace
}  // namespace gainsmith::numerics
