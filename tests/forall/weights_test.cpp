// Weights of the vertices of a box, and functions made of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <random>

#include "expr/binding/compile.h"
#include "expr/text/parser.h"
#include "forall/box.h"
#include "forall/random_atom.h"
#include "forall/variables.h"

namespace gainsmith::forall {
namespace {

using numbers::Matrix;

/// Different atoms on an interval, up to four of them.
Box random_box(std::mt19937& generator, double& low, double& high) {
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Atom> atoms;
  for (std::size_t k = 1 + generator() % 4; k > 0; --k) {
    const Atom atom = testing::random_atom(generator);
    if (!atom.is_one() && std::find(atoms.begin(), atoms.end(), atom) == atoms.end())
      atoms.push_back(atom);
  }
  low = 3 * unit(generator) - 1.5;
  high = low + 2 * unit(generator);
  return box_of(std::move(atoms), "t", low, high, {});
}

double value_of(const expr::Program& weight, double t) {
  if (weight.code.empty()) return 1;
  return numbers::evaluate(weight, numbers::Values{{"t", testing::number(t)}})(0, 0);
}

TEST(WeightsTest, AreConvexAndGiveTheFunctionsBack) {
  std::mt19937 generator(17);
  for (int trial = 0; trial < 60; ++trial) {
    double low = 0;
    double high = 0;
    const Box box = random_box(generator, low, high);
    const model::Basis basis = weights(box, "t", {});
    ASSERT_EQ(basis.elements.size(), box.vertices.size());
    for (int i = 0; i <= 40; ++i) {
      const double t = low + (high - low) * i / 40;
      double sum = 0;
      std::vector<double> theta(box.atoms.size(), 0.0);
      for (std::size_t v = 0; v < box.vertices.size(); ++v) {
        const double alpha = value_of(basis.elements[v], t);
        EXPECT_GE(alpha, -1e-12);
        sum += alpha;
        for (std::size_t k = 0; k < theta.size(); ++k) theta[k] += alpha * box.vertices[v][k];
      }
      EXPECT_NEAR(sum, 1, 1e-12);
      for (std::size_t k = 0; k < theta.size(); ++k) {
        const double size = std::abs(box.ranges[k].low) + std::abs(box.ranges[k].high);
        EXPECT_NEAR(theta[k], evaluate(box.atoms[k], t), 1e-12 * size);
      }
    }
  }
}

/// At a corner that the curve reaches the weight of that vertex is 1.
TEST(WeightsTest, AtAVertexOneWeightIsAll) {
  const Box box = box_of({{0, -1, 0, false}, {1, 0, 0, false}}, "t", 0, 2, {});
  const model::Basis basis = weights(box, "t", {});
  for (const double t : {0.0, 2.0})
    for (std::size_t v = 0; v < box.vertices.size(); ++v) {
      const bool here = box.vertices[v] == std::vector<double>{std::exp(-t), t};
      EXPECT_NEAR(value_of(basis.elements[v], t), here ? 1 : 0, 1e-15);
    }
}

bool has_same_bits(const Matrix& a, const Matrix& b) {
  if (a.rows() != b.rows() || a.cols() != b.cols()) return false;
  for (Eigen::Index i = 0; i < a.size(); ++i)
    if (std::bit_cast<std::uint64_t>(a.data()[i]) != std::bit_cast<std::uint64_t>(b.data()[i]))
      return false;
  return true;
}

/// The text, parsed and bound, has the bits of the body: a file gives what the program had.
void expect_text_is_body(const model::Function& function, double low, double high,
                         std::mt19937& generator) {
  std::uniform_real_distribution<double> unit(0, 1);
  expr::Scope scope;
  scope.symbols[function.variable] = {};
  for (const std::string& name : function.coefficients()) scope.symbols[name] = {function.shape};
  const expr::Program read = expr::compile(expr::parse({function.text(), "test"}), scope);
  const expr::Body body = function.body();
  ASSERT_EQ(read.shape(), function.shape);
  for (int trial = 0; trial < 10; ++trial) {
    numbers::Values values = {
        {function.variable, testing::number(low + (high - low) * unit(generator))}};
    for (const std::string& name : function.coefficients())
      values[name] = Matrix::NullaryExpr(function.shape.rows, function.shape.cols,
                                         [&] { return 2 * unit(generator) - 1; });
    EXPECT_TRUE(
        has_same_bits(numbers::evaluate(read, values), numbers::evaluate(body.program, values)))
        << function.text();
  }
}

TEST(WeightsTest, TheTextOfAFunctionIsItsBody) {
  std::mt19937 generator(18);
  for (int trial = 0; trial < 80; ++trial) {
    double low = 0;
    double high = 0;
    const Box box = random_box(generator, low, high);
    const expr::Shape shape = trial % 3 == 0 ? expr::Shape{} : expr::Shape{2, 1 + trial % 2};
    expect_text_is_body({"Y", "t", shape, {}, weights(box, "t", {}), {}}, low, high, generator);
    expect_text_is_body({"Y", "s", shape, {}, model::monomials("s", trial % 6, {}), {}}, -2, 2,
                        generator);
  }
}

/// One vertex: the function is its coefficient.
TEST(WeightsTest, ABoxOfOnePointHasTheConstant) {
  for (const Box& box : {box_of({}, "t", 0, 1, {}), box_of({{1, 0, 0, false}}, "t", 3, 3, {})}) {
    const model::Function function{"Y", "t", {2, 2}, {}, weights(box, "t", {}), {}};
    EXPECT_EQ(function.text(), "Y_0");
    EXPECT_EQ(function.body().program.inputs.size(), 1U);
    EXPECT_FALSE(function.body().program.uses("t"));
  }
}

}  // namespace
}  // namespace gainsmith::forall
