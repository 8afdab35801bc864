#include "forall/hull.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "lmi/compile.h"
#include "lmi/variables.h"
#include "support/input_error.h"
#include "support/yaml_problem.h"

namespace gainsmith::forall {
namespace {

using testing::interval;
using testing::number;
using testing::polytope;

/// A form in the variables, the unknowns being given matrices of the test.
struct Family {
  MonomialTable monomials;
  numbers::Values known;
  expr::Program program;
  AffineForm form;

  Family(const std::string& text, Domain domain, numbers::Values values = {})
      : monomials(std::move(domain)),
        known(std::move(values)),
        program(testing::program(text, monomials.variables(), known)),
        form(affine()) {
    remove_noise(form, monomials);
  }

  AffineForm affine() {
    const tests::YamlProblem yaml(
        "problem: p\nmethod:\n  method: m\n  unknowns: {g: scalar}\n  require: {all: g > 0}\n");
    return evaluate_affine(program, Unknowns(yaml.instance), monomials, known);
  }

  std::vector<numbers::Matrix> vertices(int slices = 1) const {
    std::vector<numbers::Matrix> result;
    for (const Vertex& vertex : hull_of(form, monomials, slices, {"test"}).vertices) {
      const AffineForm there = at_vertex(form, vertex.values);
      numbers::Matrix sum = numbers::Matrix::Zero(form.shape.rows, form.shape.cols);
      for (const auto& [key, matrix] : there.terms) sum += numbers::Matrix(matrix);
      result.push_back(std::move(sum));
    }
    return result;
  }

  /// The text itself, evaluated over double.
  numbers::Matrix at(numbers::Values point) const {
    point.insert(known.begin(), known.end());
    return numbers::evaluate(program, point);
  }
};

constexpr double kInfinity = std::numeric_limits<double>::infinity();

numbers::Matrix random_matrix(int rows, int cols, std::mt19937& generator) {
  std::uniform_real_distribution<double> number(-1, 1);
  return numbers::Matrix::NullaryExpr(rows, cols, [&] { return number(generator); });
}

/// The range of the functional M -> sum W_ij M_ij over matrices.
Range range_of(const numbers::Matrix& functional, const std::vector<numbers::Matrix>& matrices) {
  Range range{kInfinity, -kInfinity};
  for (const numbers::Matrix& matrix : matrices) {
    const double value = functional.cwiseProduct(matrix).sum();
    range.low = std::min(range.low, value);
    range.high = std::max(range.high, value);
  }
  return range;
}

/// A point is in the convex hull of the vertices exactly when no linear functional separates it
/// from them.
void expect_inside(const numbers::Matrix& matrix, const std::vector<numbers::Matrix>& vertices,
                   std::mt19937& generator) {
  for (int k = 0; k < 4; ++k) {
    const numbers::Matrix functional =
        random_matrix(static_cast<int>(matrix.rows()), static_cast<int>(matrix.cols()), generator);
    const Range range = range_of(functional, vertices);
    const double value = functional.cwiseProduct(matrix).sum();
    const double slack = 1e-10 * (1 + std::abs(range.low) + std::abs(range.high));
    EXPECT_GE(value, range.low - slack);
    EXPECT_LE(value, range.high + slack);
  }
}

TEST(HullTest, TheBoxHoldsTheMatrixExponential) {
  std::mt19937 generator(11);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int trial = 0; trial < 40; ++trial) {
    const numbers::Matrix F = 2 * random_matrix(3, 3, generator);
    const double low = unit(generator);
    const double high = low + 2 * unit(generator);
    const Family family("[expm(F*tau), M; M', expm(F*tau)']", {interval("tau", low, high)},
                        {{"F", F}, {"M", random_matrix(3, 3, generator)}});
    for (const int slices : {1, 3}) {
      const auto vertices = family.vertices(slices);
      for (int k = 0; k < 20; ++k)
        expect_inside(family.at({{"tau", number(low + (high - low) * unit(generator))}}), vertices,
                      generator);
    }
  }
}

/// Repeated eigenvalues give powers of tau, complex ones products with sin and cos.
TEST(HullTest, TheBoxHoldsAJordanBlock) {
  std::mt19937 generator(12);
  numbers::Matrix F(4, 4);
  F << -0.3, 2, 1, 0, -2, -0.3, 0, 1, 0, 0, -0.3, 2, 0, 0, -2, -0.3;
  const Family family("expm(F*tau)", {interval("tau", 0.1, 4)}, {{"F", F}});
  const auto vertices = family.vertices();
  EXPECT_EQ(vertices.size(), 16U);
  for (int k = 0; k <= 200; ++k)
    expect_inside(family.at({{"tau", number(0.1 + 3.9 * k / 200)}}), vertices, generator);
}

TEST(HullTest, TheBoxHoldsProductsOverSeveralVariablesAndAPolytope) {
  std::mt19937 generator(13);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int trial = 0; trial < 20; ++trial) {
    const std::vector<numbers::Matrix> corners = {random_matrix(2, 2, generator),
                                               random_matrix(2, 2, generator),
                                               random_matrix(2, 2, generator)};
    const Family family("s*expm(F*tau)*B + cos(3*s)*B' + s^2*exp(-tau)*F",
                        {interval("tau", 0, 1.5), interval("s", -1, 1), polytope("B", corners)},
                        {{"F", random_matrix(2, 2, generator)}});
    const auto vertices = family.vertices();
    for (int k = 0; k < 20; ++k) {
      const double a = unit(generator);
      const double b = (1 - a) * unit(generator);
      const numbers::Matrix B = a * corners[0] + b * corners[1] + (1 - a - b) * corners[2];
      expect_inside(family.at({{"tau", number(1.5 * unit(generator))},
                               {"s", number(2 * unit(generator) - 1)},
                               {"B", B}}),
                    vertices, generator);
    }
  }
}

TEST(HullTest, ExtremaInsideTheIntervalMakeTheBox) {
  // sin(2 tau) reaches 1 inside, at tau = pi/4; the ends have less.
  const Family family("[cos(2*tau), sin(2*tau)]", {interval("tau", 0.1, 1.4)});
  const auto vertices = family.vertices();
  ASSERT_EQ(vertices.size(), 4U);
  const Range cosine = range_of((numbers::Matrix(1, 2) << 1, 0).finished(), vertices);
  const Range sine = range_of((numbers::Matrix(1, 2) << 0, 1).finished(), vertices);
  EXPECT_DOUBLE_EQ(cosine.low, std::cos(2.8));
  EXPECT_DOUBLE_EQ(cosine.high, std::cos(0.2));
  EXPECT_DOUBLE_EQ(sine.low, std::sin(0.2));
  EXPECT_DOUBLE_EQ(sine.high, 1.0);
}

TEST(HullTest, MoreSlicesNeverWidenTheHull) {
  std::mt19937 generator(14);
  for (int trial = 0; trial < 20; ++trial) {
    const Family family("expm(F*tau)", {interval("tau", 0.2, 2)},
                        {{"F", 2 * random_matrix(2, 2, generator)}});
    const numbers::Matrix functional = random_matrix(2, 2, generator);
    double width = kInfinity;
    for (const int slices : {1, 2, 4, 8}) {
      const Range range = range_of(functional, family.vertices(slices));
      EXPECT_LE(range.high - range.low, width * (1 + 1e-12));
      width = range.high - range.low;
    }
    // Eight boxes are not yet the curve, but close to it.
    std::vector<numbers::Matrix> curve;
    for (int k = 0; k <= 400; ++k)
      curve.push_back(family.at({{"tau", number(0.2 + 1.8 * k / 400)}}));
    const Range exact = range_of(functional, curve);
    EXPECT_GE(width, (exact.high - exact.low) * (1 - 1e-3));
  }
}

TEST(HullTest, OneFunctionOfEachVariableLosesNothing) {
  const Family family("tau^2*[k, 1; 1, -k]", {interval("tau", -1, 2), interval("k", 1, 3)});
  const Hull hull = hull_of(family.form, family.monomials, 5, {"test"});
  EXPECT_TRUE(hull.exact);
  EXPECT_EQ(hull.vertices.size(), 4U);
  const Family two("tau*[k, 1; 1, -k] + tau^2*I", {interval("tau", -1, 2), interval("k", 1, 3)});
  const Hull loose = hull_of(two.form, two.monomials, 5, {"test"});
  EXPECT_FALSE(loose.exact);
  EXPECT_EQ(loose.vertices.size(), 5U * 4U * 2U);
}

TEST(HullTest, VerticesHaveTheNamesOfTheirPoints) {
  const Family family("exp(tau)*B", {interval("tau", 0, 2), polytope("B", {number(1), number(3)})});
  std::vector<std::string> labels;
  for (const Vertex& vertex : hull_of(family.form, family.monomials, 1, {"test"}).vertices)
    labels.push_back(vertex.label);
  std::sort(labels.begin(), labels.end());
  EXPECT_EQ(labels, (std::vector<std::string>{"tau = 0, B = 1", "tau = 0, B = 2", "tau = 2, B = 1",
                                              "tau = 2, B = 2"}));
}

TEST(HullTest, AnIntervalOfOnePointHasOneVertex) {
  const Family family("[cos(2*tau), exp(tau)]", {interval("tau", 0.7, 0.7)});
  const auto vertices = family.vertices();
  ASSERT_EQ(vertices.size(), 1U);
  EXPECT_DOUBLE_EQ(vertices[0](0, 0), std::cos(1.4));
  EXPECT_DOUBLE_EQ(vertices[0](0, 1), std::exp(0.7));
}

TEST(HullTest, WhatIsConstantHasOneVertex) {
  const Family family("cos(tau)^2 + sin(tau)^2", {interval("tau", 0, 5)});
  const auto vertices = family.vertices();
  ASSERT_EQ(vertices.size(), 1U);
  EXPECT_DOUBLE_EQ(vertices[0](0, 0), 1.0);
}

TEST(HullTest, NoiseIsWhatIsSmallOnTheWholeDomain) {
  // 1e-16 of the rest, and 1e-16 that the domain makes large.
  const Family small("exp(tau) + 1e-16*tau", {interval("tau", 0, 1)});
  EXPECT_EQ(small.vertices().size(), 2U);
  const Family large("exp(tau) + 1e-16*exp(40*tau)", {interval("tau", 0, 1)});
  EXPECT_EQ(large.vertices().size(), 4U);
}

TEST(HullTest, TooManyVerticesAreRefused) {
  std::string text = "tau";
  for (int k = 2; k <= 13; ++k) text += " + tau^" + std::to_string(k);
  const Place place{"test.yaml", 4, 2};
  const Family powers(text, {interval("tau", 0, 1)});
  const InputError error =
      tests::input_error([&] { hull_of(powers.form, powers.monomials, 1, place); });
  EXPECT_EQ(error.place(), place);
  EXPECT_NE(error.message().find("4096"), std::string::npos);
  const Family wave("[cos(tau), sin(tau)]", {interval("tau", 0, 1)});
  EXPECT_EQ(hull_of(wave.form, wave.monomials, 1024, place).vertices.size(), 4096U);
  tests::input_error([&] { hull_of(wave.form, wave.monomials, 1025, place); });
}

TEST(HullTest, FunctionsTooLargeForDoubleAreRefused) {
  const Family family("exp(tau)", {interval("tau", 0, 1000)});
  const InputError error =
      tests::input_error([&] { hull_of(family.form, family.monomials, 1, {"test"}); });
  EXPECT_NE(error.message().find("too large for double"), std::string::npos) << error.message();
}

}  // namespace
}  // namespace gainsmith::forall
