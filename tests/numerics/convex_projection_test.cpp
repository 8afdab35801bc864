// Projections onto sets of convex functions: what makes them projections, recomputed from the raw
// functions, and the projections that have a method of their own.
#include "numerics/convex_projection.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "numerics/random_sets.h"

namespace gainsmith::numerics {
namespace {

constexpr int kConvexSets = 1000;

/// (z - m)' Q (z - m) + a'z - b + e exp(g'z): convex for Q >= 0 and e >= 0.
struct Convex {
  Matrix m, Q, a, g;
  double b = 0, e = 0;
};

template <class W>
Functions<W> functions(const std::vector<Convex>& all) {
  return [&all](const MatrixOf<W>& z) {
    using std::exp;
    const auto m = static_cast<Eigen::Index>(all.size());
    Tangents<W> result{MatrixOf<W>::Zero(m, 1), MatrixOf<W>::Zero(m, z.size())};
    for (Eigen::Index i = 0; i < m; ++i) {
      const Convex& one = all[static_cast<std::size_t>(i)];
      const MatrixOf<W> from = z - one.m.cast<W>(), Q = one.Q.cast<W>();
      const MatrixOf<W> a = one.a.cast<W>(), g = one.g.cast<W>();
      const W grown = W(one.e) * exp(g.col(0).dot(z.col(0)));
      result.value(i) =
          from.col(0).dot((Q * from).col(0)) + a.col(0).dot(z.col(0)) - W(one.b) + grown;
      result.slope.row(i) = ((Q + Q.transpose()) * from + a + grown * g).transpose();
    }
    return result;
  };
}

struct RandomConvex {
  Matrix P, inside, x;
  std::vector<Convex> c;
};

/// Up to 6 functions of every kind, all of them below 0 at `inside`.
RandomConvex convex(Draw& draw) {
  const Eigen::Index n = 1 + draw.below(5);
  RandomConvex set{draw.definite(n), draw.matrix(n, 1), {}, {}};
  set.x = set.inside + std::pow(10, draw.below(3) - 1) * draw.matrix(n, 1);
  const Matrix none = Matrix::Zero(n, 1);
  for (int i = 1 + draw.below(6); i > 0; --i) {
    Convex one{draw.matrix(n, 1), Matrix::Zero(n, n), none, none};
    if (draw.coin()) {
      const Matrix G = draw.matrix(1 + draw.below(static_cast<int>(n)), n);
      one.Q = G.transpose() * G;
    }
    if (draw.coin()) one.a = draw.matrix(n, 1);
    if (draw.below(3) == 0) {
      one.e = 1;
      one.g = 2 * draw.matrix(n, 1);
    }
    set.c.push_back(one);
    const Matrix value = functions<double>(set.c)(set.inside).value;
    set.c.back().b = value(value.size() - 1) + std::pow(10, -draw.below(4));
  }
  return set;
}

TEST(ProjectConvex, IsStationaryFeasibleAndComplementary) {
  Draw draw(21);
  int outside = 0, corners = 0;
  for (int k = 0; k < kConvexSets && !testing::Test::HasFailure(); ++k) {
    SCOPED_TRACE(k);
    const RandomConvex set = convex(draw);
    const auto [z, y] = project_convex<double>(set.x, set.P, functions<DoubleDouble>(set.c));
    const auto at = functions<double>(set.c)(z);
    const Vector rest = set.P * (z - set.x) + at.slope.transpose() * y;
    const Vector most = unsure(set.P, z) + unsure(set.P, set.x) + unsure(at.slope.transpose(), y);
    // The slope turns as z is rounded.
    double turn = 0;
    for (std::size_t i = 0; i < set.c.size(); ++i) {
      const Convex& one = set.c[i];
      turn += y(static_cast<Eigen::Index>(i)) * kEpsilon * (z.norm() + one.m.norm()) *
              (2 * one.Q.norm() + one.g.squaredNorm() * std::abs(at.value(0)) + 10 * one.e);
    }
    for (Eigen::Index i = 0; i < rest.size(); ++i)
      EXPECT_LE(std::abs(rest(i)), 20 * most(i) + 20 * turn);
    for (Eigen::Index i = 0; i < y.size(); ++i) {
      const Convex& one = set.c[static_cast<std::size_t>(i)];
      const double noise = 40 * kEpsilon *
                           (unsure(at.slope, z)(i) / kEpsilon + std::abs(one.b) +
                            one.Q.norm() * (z.squaredNorm() + one.m.squaredNorm()) + one.e);
      EXPECT_LE(at.value(i), noise) << "function " << i;
      EXPECT_GE(y(i), 0) << "function " << i;
      if (y(i) == 0) continue;
      EXPECT_GE(at.value(i), -noise) << "function " << i;
    }
    outside += (y.array() > 0).any();
    corners += (y.array() > 0).count() > 1;
  }
  EXPECT_GT(outside, kConvexSets / 3);
  EXPECT_GT(corners, kConvexSets / 20);
}

TEST(ProjectConvex, ProjectsOnceAndExpandsNothing) {
  Draw draw(22);
  for (int k = 0; k < kConvexSets && !testing::Test::HasFailure(); ++k) {
    SCOPED_TRACE(k);
    const RandomConvex set = convex(draw);
    const auto c = functions<DoubleDouble>(set.c);
    const auto length = [&](const Matrix& v) {
      return std::sqrt(v.col(0).dot((set.P * v).col(0)));
    };
    const Matrix z = project_convex<double>(set.x, set.P, c).point;
    EXPECT_EQ(project_convex<double>(z, set.P, c).point, z);
    EXPECT_EQ(project_convex<double>(set.inside, set.P, c).point, set.inside);
    const Matrix other = set.x + draw.matrix(z.size(), 1);
    const Matrix there = project_convex<double>(other, set.P, c).point;
    EXPECT_LE(length(z - there),
              length(set.x - other) + 1e-14 * std::sqrt(set.P.norm()) * (z.norm() + there.norm()));
  }
}

TEST(ProjectConvex, OfOneEllipsoidIsProjectEllipsoid) {
  Draw draw(23);
  for (int k = 0; k < kConvexSets && !testing::Test::HasFailure(); ++k) {
    SCOPED_TRACE(k);
    const RandomEllipsoid set = ellipsoid(draw);
    const Matrix none = Matrix::Zero(set.x.size(), 1);
    const std::vector<Convex> one{{set.x0, set.Q, none, none, set.r(0), 0}};
    const Matrix z = project_convex<double>(set.x, set.P, functions<DoubleDouble>(one)).point;
    const Matrix expected = project_ellipsoid<double>(set.x, set.P, set.x0, set.Q, set.r).point;
    for (Eigen::Index i = 0; i < z.size(); ++i)
      EXPECT_NEAR(z(i), expected(i), 2 * kEpsilon * (std::abs(expected(i)) + set.x0.norm()));
  }
}

TEST(ProjectConvex, OfRowsIsProjectPolytope) {
  Draw draw(24);
  for (int k = 0; k < kConvexSets && !testing::Test::HasFailure(); ++k) {
    SCOPED_TRACE(k);
    const auto [P, A, b, inside, x] = polytope(draw);
    const auto rows = [&A = A, &b = b](const MatrixOf<DoubleDouble>& z) {
      const MatrixOf<DoubleDouble> slope = A.cast<DoubleDouble>();
      return Tangents<DoubleDouble>{slope * z - b.cast<DoubleDouble>(), slope};
    };
    const auto found = project_convex<double>(x, P, rows);
    EXPECT_EQ(found.point, project_polytope<double>(x, P, A, b).point);
  }
}

template <class S>
double error_in_digits(const std::vector<Convex>& c, const Matrix& x, const Matrix& P) {
  const auto to_decimal = [](const S& value) { return as<Decimal100>(value); };
  const MatrixOf<S> z = project_convex<S>(x.cast<S>(), P.cast<S>(), functions<Working<S>>(c)).point;
  const MatrixOf<Decimal100> exact =
      project_convex<Decimal100>(x.cast<Decimal100>(), P.cast<Decimal100>(),
                                 functions<Decimal100>(c))
          .point;
  return static_cast<double>((z.unaryExpr(to_decimal) - exact).norm() / exact.norm());
}

TEST(ProjectConvex, HasTheDigitsOfItsNumbers) {
  Draw draw(25);
  for (int k = 0; k < 20; ++k) {
    const RandomConvex set = convex(draw);
    EXPECT_LE(error_in_digits<double>(set.c, set.x, set.P), 3e-16);
    EXPECT_LE(error_in_digits<DoubleDouble>(set.c, set.x, set.P), 1e-31);
  }
}

/// What is said of a set without a nearest point.
std::string refusal(const Matrix& x, const Matrix& P, const std::vector<Convex>& c) {
  try {
    project_convex<double>(x, P, functions<DoubleDouble>(c));
  } catch (const NoProjection& error) {
    return error.what();
  }
  return "";
}

TEST(ProjectConvex, SaysWhyThereIsNoPoint) {
  const Matrix I = Matrix::Identity(2, 2), o = Matrix::Zero(2, 1), x{{3}, {4}};
  const Matrix right{{1}, {0}}, up{{0}, {1}};
  const Convex ball{o, I, o, o, 1, 0};
  EXPECT_EQ(refusal(x, -I, {ball}), "P is not positive definite");
  // A ball and a half space or a ball apart from it; a constant above 0; exp(z) <= -1.
  EXPECT_EQ(refusal(x, I, {ball, {o, 0 * I, -right, o, -2, 0}}),
            "the set is empty, or c is not convex");
  EXPECT_EQ(refusal(x, I, {ball, {x, I, o, o, 1, 0}}), "the set is empty, or c is not convex");
  EXPECT_EQ(refusal(x, I, {{o, 0 * I, o, o, -1, 0}}), "the set is empty, or c is not convex");
  EXPECT_NE(refusal(x, I, {{o, 0 * I, o, up, -1, 1}}), "");
  // Outside of a ball; below a hill.
  EXPECT_NE(refusal(x / 10, I, {{o, -I, o, o, -1, 0}}).find("c(1) is not convex"),
            std::string::npos);
  EXPECT_NE(refusal(x, I, {{o, 0 * I, right, o, 9, 0}, {o, -I / 8, up, o, -1, 0}})
                .find("c(2) is not convex"),
            std::string::npos);
}

/// max(z(1) + z(2) - 1, 0)^2 <= 0 has no point below 0, and so no multipliers.
TEST(ProjectConvex, NeedsAPointBelowZero) {
  const auto square = [](const MatrixOf<DoubleDouble>& z) {
    const DoubleDouble over = std::max(z(0) + z(1) - DoubleDouble(1), DoubleDouble(0));
    return Tangents<DoubleDouble>{MatrixOf<DoubleDouble>::Constant(1, 1, over * over),
                                  MatrixOf<DoubleDouble>::Constant(1, 2, DoubleDouble(2) * over)};
  };
  const Matrix I = Matrix::Identity(2, 2);
  EXPECT_THROW(project_convex<double>(Matrix{{3}, {1}}, I, square), NoProjection);
  EXPECT_EQ(project_convex<double>(Matrix{{-3}, {1}}, I, square).point, (Matrix{{-3}, {1}}));
}

}  // namespace
}  // namespace gainsmith::numerics
