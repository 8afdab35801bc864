#include "forall/hull.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "forall/forms.h"
#include "forall/variables.h"
#include "numbers/dense/dense.h"
#include "support/input_error.h"

namespace gainsmith::forall {
namespace {

using numbers::Matrix;
using testing::Form;
using testing::interval;
using testing::number;
using testing::polytope;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// t^power, exp(rate t), cos(b t), sin(b t).
Atom power(int k) { return {k, 0, 0, false}; }
Atom growth(double rate) { return {0, rate, 0, false}; }
Atom cosine(double b) { return {0, 0, b, false}; }
Atom sine(double b) { return {0, 0, b, true}; }

Matrix random_matrix(int rows, int cols, std::mt19937& generator) {
  std::uniform_real_distribution<double> entry(-1, 1);
  return Matrix::NullaryExpr(rows, cols, [&] { return entry(generator); });
}

/// The sum of atoms with the coefficients given, in one variable over an interval.
Form sum_of(const Variable& axis, const std::vector<std::pair<Atom, Matrix>>& parts) {
  Form form({axis});
  for (const auto& [atom, M] : parts) form.add({form.monomials.index(0, atom)}, M);
  return form;
}

/// expm(F tau).
Form exponential(const Matrix& F, const Variable& axis) {
  Form form({axis});
  for (const auto& [index, R] : form.exponential(F, 0)) form.add({index}, R);
  return form;
}

/// The range of the functional M -> sum W_ij M_ij over matrices.
Range range_of(const Matrix& functional, const std::vector<Matrix>& matrices) {
  Range range{kInfinity, -kInfinity};
  for (const Matrix& matrix : matrices) {
    const double value = functional.cwiseProduct(matrix).sum();
    range.low = std::min(range.low, value);
    range.high = std::max(range.high, value);
  }
  return range;
}

/// A point is in the convex hull of the vertices exactly when no linear functional separates it
/// from them.
void expect_inside(const Matrix& matrix, const std::vector<Matrix>& vertices,
                   std::mt19937& generator) {
  for (int k = 0; k < 4; ++k) {
    const Matrix functional =
        random_matrix(static_cast<int>(matrix.rows()), static_cast<int>(matrix.cols()), generator);
    const Range range = range_of(functional, vertices);
    const double value = functional.cwiseProduct(matrix).sum();
    const double slack = 1e-10 * (1 + std::abs(range.low) + std::abs(range.high));
    EXPECT_GE(value, range.low - slack);
    EXPECT_LE(value, range.high + slack);
  }
}

/// [expm(F tau), M; M', expm(F tau)'].
TEST(HullTest, TheBoxHoldsTheMatrixExponential) {
  std::mt19937 generator(11);
  std::uniform_real_distribution<double> unit(0, 1);
  const auto corners = [](const Matrix& a, const Matrix& b, const Matrix& c, const Matrix& d) {
    Matrix whole(6, 6);
    whole << a, b, c, d;
    return whole;
  };
  const Matrix zero = Matrix::Zero(3, 3);
  for (int trial = 0; trial < 40; ++trial) {
    const Matrix F = 2 * random_matrix(3, 3, generator);
    const Matrix M = random_matrix(3, 3, generator);
    const double low = unit(generator);
    const double high = low + 2 * unit(generator);
    Form form({interval("tau", low, high)});
    for (const auto& [index, R] : form.exponential(F, 0))
      form.add({index}, corners(R, zero, zero, R.transpose()));
    form.add({}, corners(zero, M, M.transpose(), zero));
    for (const int slices : {1, 3}) {
      const auto vertices = form.vertices(slices);
      for (int k = 0; k < 20; ++k) {
        const Matrix E = numbers::exponential(F * (low + (high - low) * unit(generator)));
        expect_inside(corners(E, M, M.transpose(), E.transpose()), vertices, generator);
      }
    }
  }
}

/// Repeated eigenvalues give powers of tau, complex ones products with sin and cos.
TEST(HullTest, TheBoxHoldsAJordanBlock) {
  std::mt19937 generator(12);
  Matrix F(4, 4);
  F << -0.3, 2, 1, 0, -2, -0.3, 0, 1, 0, 0, -0.3, 2, 0, 0, -2, -0.3;
  const auto vertices = exponential(F, interval("tau", 0.1, 4)).vertices();
  EXPECT_EQ(vertices.size(), 16U);
  for (int k = 0; k <= 200; ++k)
    expect_inside(numbers::exponential(F * (0.1 + 3.9 * k / 200)), vertices, generator);
}

/// s expm(F tau) B + cos(3 s) B' + s^2 exp(-tau) F.
TEST(HullTest, TheBoxHoldsProductsOverSeveralVariablesAndAPolytope) {
  std::mt19937 generator(13);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int trial = 0; trial < 20; ++trial) {
    const std::vector<Matrix> corners = {random_matrix(2, 2, generator),
                                         random_matrix(2, 2, generator),
                                         random_matrix(2, 2, generator)};
    const Matrix F = random_matrix(2, 2, generator);
    Form form({interval("tau", 0, 1.5), interval("s", -1, 1), polytope("B", corners)});
    MonomialTable& table = form.monomials;
    std::vector<std::pair<int, Matrix>> B = {{0, corners[0]}};
    for (const int j : {1, 2})
      B.emplace_back(table.index_of_weight(2, j),
                     corners[static_cast<std::size_t>(j)] - corners[0]);
    for (const auto& [weight, D] : B) {
      for (const auto& [index, R] : form.exponential(F, 0))
        form.add({table.index(1, power(1)), index, weight}, R * D);
      form.add({table.index(1, cosine(3)), weight}, D.transpose());
    }
    form.add({table.index(1, power(2)), table.index(0, growth(-1))}, F);
    const auto vertices = form.vertices();
    for (int k = 0; k < 20; ++k) {
      const double a = unit(generator);
      const double b = (1 - a) * unit(generator);
      const double tau = 1.5 * unit(generator);
      const double s = 2 * unit(generator) - 1;
      const Matrix at = a * corners[0] + b * corners[1] + (1 - a - b) * corners[2];
      expect_inside(s * numbers::exponential(F * tau) * at + std::cos(3 * s) * at.transpose() +
                        s * s * std::exp(-tau) * F,
                    vertices, generator);
    }
  }
}

/// sin(2 tau) reaches 1 inside, at tau = pi/4; the ends have less.
TEST(HullTest, ExtremaInsideTheIntervalMakeTheBox) {
  const Matrix first{{1, 0}};
  const Matrix second{{0, 1}};
  const auto vertices =
      sum_of(interval("tau", 0.1, 1.4), {{cosine(2), first}, {sine(2), second}}).vertices();
  ASSERT_EQ(vertices.size(), 4U);
  EXPECT_DOUBLE_EQ(range_of(first, vertices).low, std::cos(2.8));
  EXPECT_DOUBLE_EQ(range_of(first, vertices).high, std::cos(0.2));
  EXPECT_DOUBLE_EQ(range_of(second, vertices).low, std::sin(0.2));
  EXPECT_DOUBLE_EQ(range_of(second, vertices).high, 1.0);
}

TEST(HullTest, MoreSlicesNeverWidenTheHull) {
  std::mt19937 generator(14);
  for (int trial = 0; trial < 20; ++trial) {
    const Matrix F = 2 * random_matrix(2, 2, generator);
    const Form form = exponential(F, interval("tau", 0.2, 2));
    const Matrix functional = random_matrix(2, 2, generator);
    double width = kInfinity;
    for (const int slices : {1, 2, 4, 8}) {
      const Range range = range_of(functional, form.vertices(slices));
      EXPECT_LE(range.high - range.low, width * (1 + 1e-12));
      width = range.high - range.low;
    }
    // Eight boxes are not yet the curve, but close to it.
    std::vector<Matrix> curve;
    for (int k = 0; k <= 400; ++k) curve.push_back(numbers::exponential(F * (0.2 + 1.8 * k / 400)));
    const Range exact = range_of(functional, curve);
    EXPECT_GE(width, (exact.high - exact.low) * (1 - 1e-3));
  }
}

TEST(HullTest, OneFunctionOfEachVariableLosesNothing) {
  const auto of_both = [](int first) {
    Form form({interval("tau", -1, 2), interval("k", 1, 3)});
    const int tau = form.monomials.index(0, power(first));
    form.add({tau, form.monomials.index(1, power(1))}, Matrix{{1, 0}, {0, -1}});
    form.add({tau}, Matrix{{0, 1}, {1, 0}});
    return form;
  };
  const Hull hull = of_both(2).hull(5);
  EXPECT_TRUE(hull.exact);
  EXPECT_EQ(hull.vertices.size(), 4U);
  Form two = of_both(1);
  two.add({two.monomials.index(0, power(2))}, Matrix::Identity(2, 2));
  const Hull loose = two.hull(5);
  EXPECT_FALSE(loose.exact);
  EXPECT_EQ(loose.vertices.size(), 5U * 4U * 2U);
}

/// The range of t cos(t) is bounded from outside: its end is no value that the function takes.
TEST(HullTest, ABoundFromOutsideIsNotExact) {
  EXPECT_FALSE(sum_of(interval("tau", 0, 5), {{{1, 0, 1, false}, number(1)}}).hull().exact);
  EXPECT_TRUE(sum_of(interval("tau", 0, 5), {{{1, -1, 0, false}, number(1)}}).hull().exact);
}

TEST(HullTest, VerticesHaveTheNamesOfTheirPoints) {
  Form form({interval("tau", 0, 2), polytope("B", {number(1), number(3)})});
  const int growing = form.monomials.index(0, growth(1));
  form.add({growing}, number(1));
  form.add({growing, form.monomials.index_of_weight(1, 1)}, number(2));
  std::vector<std::string> labels;
  for (const Vertex& vertex : form.hull().vertices) labels.push_back(vertex.label);
  std::sort(labels.begin(), labels.end());
  EXPECT_EQ(labels, (std::vector<std::string>{"tau = 0, B = 1", "tau = 0, B = 2", "tau = 2, B = 1",
                                              "tau = 2, B = 2"}));
}

TEST(HullTest, AnIntervalOfOnePointHasOneVertex) {
  const auto vertices =
      sum_of(interval("tau", 0.7, 0.7), {{cosine(2), Matrix{{1, 0}}}, {growth(1), Matrix{{0, 1}}}})
          .vertices();
  ASSERT_EQ(vertices.size(), 1U);
  EXPECT_DOUBLE_EQ(vertices[0](0, 0), std::cos(1.4));
  EXPECT_DOUBLE_EQ(vertices[0](0, 1), std::exp(0.7));
}

/// cos(tau)^2 + sin(tau)^2.
TEST(HullTest, WhatIsConstantHasOneVertex) {
  Form form({interval("tau", 0, 5)});
  for (const Atom& wave : {cosine(1), sine(1)}) {
    const int index = form.monomials.index(0, wave);
    form.add({index, index}, number(1));
  }
  const auto vertices = form.vertices();
  ASSERT_EQ(vertices.size(), 1U);
  EXPECT_DOUBLE_EQ(vertices[0](0, 0), 1.0);
}

TEST(HullTest, NoiseIsWhatIsSmallOnTheWholeDomain) {
  // 1e-16 of the rest, and 1e-16 that the domain makes large.
  const auto with = [](const Atom& atom) {
    return sum_of(interval("tau", 0, 1), {{growth(1), number(1)}, {atom, number(1e-16)}});
  };
  EXPECT_EQ(with(power(1)).vertices().size(), 2U);
  EXPECT_EQ(with(growth(40)).vertices().size(), 4U);
}

TEST(HullTest, TooManyVerticesAreRefused) {
  const Place place{"test.yaml", 4, 2};
  std::vector<std::pair<Atom, Matrix>> parts;
  for (int k = 1; k <= 13; ++k) parts.emplace_back(power(k), number(1));
  const InputError error =
      tests::input_error([&] { sum_of(interval("tau", 0, 1), parts).hull(1, place); });
  EXPECT_EQ(error.place(), place);
  EXPECT_NE(error.message().find("4096"), std::string::npos);
  const Form wave =
      sum_of(interval("tau", 0, 1), {{cosine(1), Matrix{{1, 0}}}, {sine(1), Matrix{{0, 1}}}});
  EXPECT_EQ(wave.hull(1024, place).vertices.size(), 4096U);
  tests::input_error([&] { wave.hull(1025, place); });
}

TEST(HullTest, FunctionsTooLargeForDoubleAreRefused) {
  const Form form = sum_of(interval("tau", 0, 1000), {{growth(1), number(1)}});
  const InputError error = tests::input_error([&] { form.hull(); });
  EXPECT_NE(error.message().find("too large for double"), std::string::npos) << error.message();
}

}  // namespace
}  // namespace gainsmith::forall
