// Every error of residuals.h, recomputed from the problem as given.
#include "sdp/core/residuals.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <limits>

#include "support/linear_algebra.h"
#include "support/sdp_check.h"
#include "support/sdp_dense.h"

namespace gainsmith::sdp {
namespace {

using testing::Real;
using testing::Square;

template <typename T>
class ResidualsOf : public ::testing::Test {};
using Scalars = ::testing::Types<double, DoubleDouble, Decimal100>;
TYPED_TEST_SUITE(ResidualsOf, Scalars);

/// A random point of the working problem and, in long double, what it is on the problem as given.
template <typename T>
struct ResidualSetting {
  ResidualSetting(const Problem& given, std::uint64_t seed)
      : problem(given), presolved(presolve(given)), point(presolved.data) {
    testing::fill(seed, point.x);
    testing::fill_positive(seed + 1, point.X);
    testing::fill_positive(seed + 2, point.Y);
    point.tau = T(2) / T(3);
    point.kappa = T(0.25);
    const Recovery& r = presolved.recovery;
    const Real tau = number(point.tau);
    x.assign(problem.c.size(), 0);
    for (std::size_t i = 0; i < r.constraint.size(); ++i)
      x[static_cast<std::size_t>(r.constraint[i])] =
          number(point.x[static_cast<Eigen::Index>(i)]) * r.gamma_f * r.s[i] / tau;
    X = original(point.X, r.gamma_f / tau);
    Y = original(point.Y, r.gamma_c / tau);
  }

  static Real number(const T& value) {
    const auto high = static_cast<double>(value);
    return static_cast<Real>(high) + static_cast<double>(T(value - T(high)));
  }

  /// factor times a working matrix, its rows where they came from.
  std::vector<Square> original(const Blocks<T>& matrix, Real factor) const {
    std::vector<Square> result = testing::combine(problem, std::vector<Real>(problem.c.size()), 0);
    const Recovery& r = presolved.recovery;
    for (std::size_t b = 0; b < r.dense.size(); ++b) {
      const auto block = matrix.dense(static_cast<int>(b));
      for (Eigen::Index j = 0; j < block.cols(); ++j)
        for (Eigen::Index i = 0; i < block.rows(); ++i)
          at(result, r.dense[b][static_cast<std::size_t>(i)],
             r.dense[b][static_cast<std::size_t>(j)]) = factor * number(block(i, j));
    }
    for (std::size_t k = 0; k < r.linear.size(); ++k)
      at(result, r.linear[k], r.linear[k]) =
          factor * number(matrix.linear()[static_cast<Eigen::Index>(k)]);
    return result;
  }

  Real& at(std::vector<Square>& matrix, const Recovery::Row& row,
           const Recovery::Row& column) const {
    const auto n =
        static_cast<std::size_t>(problem.blocks[static_cast<std::size_t>(row.block)].size);
    return matrix[static_cast<std::size_t>(row.block)]
                 [static_cast<std::size_t>(row.row) + n * static_cast<std::size_t>(column.row)];
  }

  /// The Frobenius norms of the parts of `matrix` that are blocks of the working problem.
  std::vector<Real> norms(std::vector<Square> matrix) const {
    std::vector<Real> result;
    for (const auto& rows : presolved.recovery.dense) {
      Real square = 0;
      for (const auto& row : rows)
        for (const auto& column : rows) square += std::pow(at(matrix, row, column), 2);
      result.push_back(std::sqrt(square));
    }
    for (const auto& row : presolved.recovery.linear)
      result.push_back(std::abs(at(matrix, row, row)));
    return result;
  }

  Real cost(std::size_t i) const { return static_cast<Real>(problem.c[i]) + rest(i); }
  Real rest(std::size_t i) const {
    return std::is_same_v<T, double> || problem.c_rest.empty() ? 0 : problem.c_rest[i];
  }

  const Problem& problem;
  Presolved presolved;
  Iterate<T> point;
  std::vector<Real> x;
  std::vector<Square> X, Y;
};

std::vector<Square> minus(std::vector<Square> a, const std::vector<Square>& b) {
  for (std::size_t k = 0; k < a.size(); ++k)
    for (std::size_t i = 0; i < a[k].size(); ++i) a[k][i] -= b[k][i];
  return a;
}

Real dot(const std::vector<Square>& a, const std::vector<Square>& b) {
  Real sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k)
    for (std::size_t i = 0; i < a[k].size(); ++i) sum += a[k][i] * b[k][i];
  return sum;
}

void expect_near(double got, Real expected, Real scale, const char* what) {
  EXPECT_NEAR(got, static_cast<double>(expected), static_cast<double>(1e-12L * scale)) << what;
}

// In double the rests of the entries are left out, which the tolerance covers.
TYPED_TEST(ResidualsOf, AreThoseOfTheProblemAsGiven) {
  for (const auto& [name, problem] : testing::random_problems(41)) {
    SCOPED_TRACE(name);
    const ResidualSetting<TypeParam> at(problem, 3);
    Residuals<TypeParam> residuals(problem, at.presolved);
    residuals.update(at.point);

    Real largest_c = 0, largest_f0 = 0, primal = 0, dual = 0, dual_square = 0, moved = 0;
    for (std::size_t i = 0; i < problem.c.size(); ++i) {
      largest_c = std::max<Real>(largest_c, std::abs(problem.c[i]));
      primal += at.cost(i) * at.x[i];
      const Real r = testing::inner(problem, problem.f[i + 1], at.Y) - at.cost(i);
      dual_square += r * r;
      moved += std::abs(r * at.x[i]);
    }
    for (const Entry& e : problem.f[0]) largest_f0 = std::max<Real>(largest_f0, std::abs(e.value));
    dual = testing::inner(problem, problem.f[0], at.Y);
    const auto defect = minus(testing::combine(problem, at.x, 1), at.X);
    const auto defect_norms = at.norms(defect), y_norms = at.norms(at.Y);
    for (std::size_t b = 0; b < y_norms.size(); ++b) moved += defect_norms[b] * y_norms[b];
    const Real size = 1 + std::abs(primal) + std::abs(dual);

    expect_near(residuals.primal_objective, primal, size, "c'x");
    expect_near(residuals.dual_objective, dual, size, "F_0.Y");
    expect_near(residuals.gap, (primal - dual) / size, 10, "gap");
    const Real complementarity = dot(at.X, at.Y) / size;
    expect_near(residuals.complementarity, complementarity, complementarity, "X.Y");
    const Real primal_error = std::sqrt(dot(defect, defect)) / (1 + largest_f0);
    expect_near(residuals.primal_infeasibility, primal_error, primal_error, "primal");
    const Real dual_error = std::sqrt(dual_square) / (1 + largest_c);
    expect_near(residuals.dual_infeasibility, dual_error, dual_error, "dual");
    expect_near(residuals.objective_error, moved / size, moved / size, "objective error");
    EXPECT_EQ(residuals.worst(),
              std::max({std::abs(residuals.gap), residuals.complementarity,
                        residuals.primal_infeasibility, residuals.dual_infeasibility,
                        residuals.objective_error}));
  }
}

TYPED_TEST(ResidualsOf, AreTheDefectOfTheModel) {
  using T = TypeParam;
  for (const auto& [name, problem] : testing::random_problems(42)) {
    SCOPED_TRACE(name);
    const ResidualSetting<T> at(problem, 4);
    Residuals<T> residuals(problem, at.presolved);
    residuals.update(at.point);
    const testing::Dense<T> dense(at.presolved.data);
    const auto image = dense.combine(at.point.x, at.point.tau);
    const auto R = testing::plus(image, T(-1), testing::full(at.point.X));
    const double epsilon = 1e3 * static_cast<double>(std::numeric_limits<T>::epsilon());
    EXPECT_LT(testing::largest(testing::plus(testing::full(residuals.defect.primal), T(-1), R)),
              epsilon * (1 + testing::largest(image)));
    const Vector<T> products = dense.products(testing::full(at.point.Y));
    const Vector<T> r = at.point.tau * dense.c - products;
    EXPECT_LT(testing::largest(Vector<T>(residuals.defect.dual - r)),
              epsilon * (1 + testing::largest(products)));
  }
}

// Y/F_0.Y, x/-c'x and their negatives: one of each pair is a direction of improvement.
TYPED_TEST(ResidualsOf, AreThoseOfCertificates) {
  using T = TypeParam;
  for (const auto& [name, problem] : testing::random_problems(43)) {
    SCOPED_TRACE(name);
    ResidualSetting<T> at(problem, 5);
    for (const double sign : {1.0, -1.0}) {
      at.point.x *= T(sign);
      Residuals<T> residuals(problem, at.presolved);
      residuals.update(at.point);
      Real products = 0, descent = 0;
      for (std::size_t i = 0; i < problem.c.size(); ++i) {
        products += std::abs(testing::inner(problem, problem.f[i + 1], at.Y));
        descent -= sign * at.cost(i) * at.x[i];
      }
      const Real ascent = testing::inner(problem, problem.f[0], at.Y);
      if (ascent > 0)
        expect_near(residuals.primal_certificate, products / ascent, products / ascent, "Y");
      else
        EXPECT_TRUE(std::isinf(residuals.primal_certificate));
      if (descent <= 0) {
        EXPECT_TRUE(std::isinf(residuals.dual_certificate));
        continue;
      }
      std::vector<Real> direction = at.x;
      for (Real& v : direction) v *= sign;
      const auto defect = minus(testing::combine(problem, direction, 1), at.X);
      Real f0 = 0;
      for (const Entry& e : problem.f[0]) f0 += (e.row == e.column ? 1 : 2) * std::pow(e.value, 2);
      const Real bound = (std::sqrt(dot(defect, defect)) + std::sqrt(f0)) / descent;
      expect_near(residuals.dual_certificate, bound, bound, "x");
      // It is a bound of what it stands for.
      Real negative = 0;
      for (const Square& block : testing::combine(problem, direction, 0)) {
        const auto n =
            static_cast<Eigen::Index>(std::lround(std::sqrt(static_cast<double>(block.size()))));
        Eigen::MatrixXd rounded(n, n);
        for (std::size_t k = 0; k < block.size(); ++k)
          rounded.data()[k] = static_cast<double>(block[k]);
        for (const double l : tests::symmetric_eigenvalues(rounded)) negative += l < 0 ? l * l : 0;
      }
      EXPECT_LE(std::sqrt(negative) / descent, bound * (1 + 1e-12L));
    }
  }
}

TYPED_TEST(ResidualsOf, KnowWhatRoundingDoes) {
  using T = TypeParam;
  const Real epsilon = static_cast<double>(std::numeric_limits<T>::epsilon());
  for (const auto& [name, problem] : testing::random_problems(44)) {
    SCOPED_TRACE(name);
    const ResidualSetting<T> at(problem, 6);
    Residuals<T> residuals(problem, at.presolved);
    residuals.update(at.point);
    Real largest_c = 0, largest_f0 = 0, terms = 0;
    for (const double c : problem.c) largest_c = std::max<Real>(largest_c, std::abs(c));
    for (const Entry& e : problem.f[0]) largest_f0 = std::max<Real>(largest_f0, std::abs(e.value));
    // epsilon sum |x_i| ||F_i||, the norms taken from 1 to 2 times the power of two below them.
    for (std::size_t i = 0; i < at.x.size(); ++i)
      terms += std::abs(at.x[i]) * frobenius_norm(problem.f[i + 1]);
    const Real exact = epsilon * terms / (1 + largest_f0);
    EXPECT_LE(residuals.primal_rounding, exact * (1 + 1e-12L));
    EXPECT_GE(2 * residuals.primal_rounding, exact);
    const Real dual = epsilon * std::sqrt(dot(at.Y, at.Y)) / (1 + largest_c);
    expect_near(residuals.dual_rounding / static_cast<double>(epsilon), dual / epsilon,
                dual / epsilon, "Y");
  }
}

// r of that norm along the equation that scaling enlarged most has an infeasibility of 1, any other
// at most that.
TYPED_TEST(ResidualsOf, HaveAUnit) {
  for (const auto& [name, problem] : testing::random_problems(45)) {
    SCOPED_TRACE(name);
    const Presolved presolved = presolve(problem);
    const Residuals<TypeParam> residuals(problem, presolved);
    double largest_c = 0, worst = 0;
    for (const double c : problem.c) largest_c = std::max(largest_c, std::abs(c));
    for (const double s : presolved.recovery.s) {
      const double original = residuals.dual_unit() * presolved.recovery.gamma_c / s;
      worst = std::max(worst, original / (1 + largest_c));
    }
    EXPECT_NEAR(worst, 1, 1e-12);
  }
}

}  // namespace
}  // namespace gainsmith::sdp
