#include "numbers/graph/exponential_formula.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "numbers/dense/dense.h"

namespace gainsmith::numbers {
namespace {

Matrix matrix(int size, std::initializer_list<double> by_rows) {
  Matrix result(size, size);
  int k = 0;
  for (const double value : by_rows) {
    result(k / size, k % size) = value;
    ++k;
  }
  return result;
}

/// The nodes at s, the only input.
Matrix values(const ScalarGraph& graph, const std::vector<int>& nodes, double s) {
  std::vector<double> all;
  const auto of = [&](int at) { return at < 0 ? 0 : all[static_cast<std::size_t>(at)]; };
  for (std::size_t k = 0; k < graph.nodes().size(); ++k) {
    const ScalarGraph::Node& node = graph.nodes()[k];
    all.push_back(node.op == ScalarOp::input ? s
                  : node.op == ScalarOp::constant
                      ? graph.value(static_cast<int>(k))
                      : apply(node.op, of(node.a), of(node.b), of(node.c)));
  }
  const auto size = static_cast<Eigen::Index>(std::lround(std::sqrt(nodes.size())));
  Matrix result(size, size);
  for (std::size_t k = 0; k < nodes.size(); ++k)
    result(static_cast<Eigen::Index>(k)) = of(nodes[k]);
  return result;
}

/// The largest difference from e^(A s), relative to its largest element; 1 where there is no
/// formula.
double difference(const Matrix& A, double s) {
  ScalarGraph graph;
  const auto nodes = exponential_nodes({A, graph.input(0)}, graph);
  if (!nodes) return 1;
  const Matrix truth = exponential(A * s);
  return (values(graph, *nodes, s) - truth).cwiseAbs().maxCoeff() / truth.cwiseAbs().maxCoeff();
}

const std::vector<double> moments = {-3, -0.1, 0, 1e-9, 0.4, 2, 15};

TEST(ExponentialFormula, HasTheValuesOfTheExponential) {
  const std::vector<Matrix> examples = {
      matrix(2, {0, 1, 0, 0}),                                              // two integrators
      matrix(3, {0, 1, 0, 0, 0, 1, 0, 0, 0}),                               // three
      matrix(2, {0, 2, -2, 0}),                                             // an oscillator
      matrix(3, {-1, 1, 0, 0, -1, 0, 0, 0, 0.5}),                           // an eigenvalue twice
      matrix(4, {0, 1, 1, 0, -1, 0, 0, 1, 0, 0, 0, 1, 0, 0, -1, 0}),        // a pair twice
      matrix(4, {0, 1, 0, 0, 0, -0.2, 3, 0, 0, 0, 0, 1, 0, 0.1, -10, -2}),  // a cart with a load
      matrix(4, {0, 1, 1, 0, 0, -0.1, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0}),       // drag with its input
      matrix(2, {0, 1, -40, -13}) * 1e-4,
      Matrix::Zero(2, 2),
      Matrix::Identity(3, 3) * -0.7};
  for (const Matrix& A : examples)
    for (const double s : moments) EXPECT_LT(difference(A, s), 1e-12) << A << "\nat s = " << s;
}

TEST(ExponentialFormula, OfRandomMatrices) {
  std::mt19937 random(1);  // NOLINT(cert-msc51-cpp): the same matrices each time
  std::normal_distribution<double> normal;
  int formulas = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const int n = 2 + trial % 5;
    const Matrix A = Matrix::NullaryExpr(n, n, [&] { return normal(random); });
    ScalarGraph graph;
    if (!exponential_nodes({A, graph.input(0)}, graph)) continue;
    ++formulas;
    for (const double s : moments) EXPECT_LT(difference(A, s), 1e-11) << A << "\nat s = " << s;
  }
  EXPECT_GT(formulas, 50);
}

TEST(ExponentialFormula, UnitsDoNotMatter) {
  const Matrix A = matrix(3, {0, 0x1p20, 0, -0x1p-21, -0.3, 0x1p9, 0, 0, -2});
  EXPECT_LT(difference(A, 0.7), 1e-12);
  EXPECT_LT(difference(A * 0x1p30, 0x1p-30), 1e-12);
}

TEST(ExponentialFormula, NoneWhereItWouldLoseDigits) {
  EXPECT_EQ(difference(matrix(2, {-1, 1, 0, -1.0001}), 1), 1);
  EXPECT_LT(difference(matrix(2, {-1, 1, 0, -1.1}), 1), 1e-12);
  EXPECT_EQ(difference(Matrix::Identity(11, 11), 1), 1);
  EXPECT_EQ(difference(Matrix::Constant(2, 2, NAN), 1), 1);
}

TEST(ExponentialFormula, KnowsMultiplesOfOneNumber) {
  ScalarGraph graph;
  const int s = graph.input(0), t = graph.input(1);
  const int twice = graph.multiply(graph.constant(2), s), zero = graph.constant(0);
  const auto found = as_multiple({s, twice, zero, graph.negate(s)}, 2, graph);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->number, s);
  EXPECT_EQ(found->factor, matrix(2, {1, 0, 2, -1}));
  const int back = graph.multiply(graph.constant(3), graph.negate(s));
  const auto negated = as_multiple({graph.negate(s), back, zero, s}, 2, graph);
  ASSERT_TRUE(negated);
  EXPECT_EQ(negated->number, s);
  EXPECT_EQ(negated->factor, matrix(2, {-1, 0, -3, 1}));
  EXPECT_FALSE(as_multiple({s, twice, zero, t}, 2, graph));
  EXPECT_FALSE(as_multiple({s, graph.constant(3), zero, s}, 2, graph));
  const auto constant = as_multiple({graph.constant(3), zero, zero, graph.constant(-1)}, 2, graph);
  ASSERT_TRUE(constant);
  EXPECT_EQ(constant->factor, matrix(2, {3, 0, 0, -1}));
  EXPECT_EQ(graph.value(constant->number), 1);
}

}  // namespace
}  // namespace gainsmith::numbers
