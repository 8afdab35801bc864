#include "lmi/gain_bounds.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <random>

#include "support/yaml_problem.h"

namespace gainsmith::lmi {
namespace {

std::string problem_with(const std::string& gains) {
  return "problem: p\nmethod:\n  method: m\n  data: {A: n x n, C: p x n}\n"
         "  unknowns: {P: symmetric n, Q: symmetric p, Y: n x p, Z: p x n, K: p x n}\n"
         "  require: {positive: P > 0}\n  gains: {" +
         gains +
         "}\n"
         "data: {A: [[0, 1, 0], [0, 0, 1], [1, 0, 0]], C: [[1, 0, 0], [0, 1, 0]]}\n";
}

std::vector<std::string> names(const GainBounds& bounds) {
  std::vector<std::string> result;
  for (const GainBound& bound : bounds.list) result.push_back(bound.what);
  return result;
}

TEST(GainBoundsTest, EveryProductWithAnInverseIsFoundOnce) {
  const tests::YamlProblem yaml(problem_with(
      "L: inv(P)*Y, M: 3*inv(P)*Y, H: inv(Q)*(Z*A + Z) - C*inv(P)*Y*C, G: Z*inv(P), K: K"));
  const GainBounds bounds = gain_bounds(yaml.instance, Unknowns(yaml.instance), 100);
  EXPECT_EQ(names(bounds), (std::vector<std::string>{"inv(P)*Y", "inv(Q)*(Z*A + Z)", "inv(P)*Y*C",
                                                     "Z*inv(P)", "K"}));
  EXPECT_EQ(bounds.scalars, 2);
}

TEST(GainBoundsTest, TheWholeProductAndAffineGainsAreBounded) {
  const tests::YamlProblem yaml(problem_with("L: inv(P)*C'*Q*2, M: 2*K + K, N: inv(P)*Y*inv(Q)"));
  const GainBounds bounds = gain_bounds(yaml.instance, Unknowns(yaml.instance), 100);
  EXPECT_EQ(names(bounds),
            (std::vector<std::string>{"inv(P)*C'*Q*2", "(2*K + K)", "inv(P)*Y", "Y*inv(Q)"}));
}

TEST(GainBoundsTest, NoBoundNoBlocks) {
  const tests::YamlProblem yaml(problem_with("L: inv(P)*Y"));
  EXPECT_TRUE(gain_bounds(yaml.instance, Unknowns(yaml.instance), std::nullopt).blocks.empty());
}

/// Random unknowns: the blocks are positive for some s exactly when the measure that is reported is
/// below beta, and the measure is never below the gain's norm.
TEST(GainBoundsTest, BlocksSayTheSameAsTheMeasure) {
  const tests::YamlProblem yaml(problem_with("L: inv(P)*Y"));
  const Unknowns unknowns(yaml.instance);
  const double beta = 3;
  const GainBounds bounds = gain_bounds(yaml.instance, unknowns, beta);
  std::mt19937 generator(3);
  std::normal_distribution<double> number;
  int inside = 0;
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<double> x(static_cast<std::size_t>(unknowns.size()) + 1);
    for (double& value : x) value = number(generator);
    const expr::Matrix root = expr::Matrix::NullaryExpr(3, 3, [&] { return number(generator); });
    const expr::Matrix P = root * root.transpose() + 0.1 * expr::Matrix::Identity(3, 3);
    for (int k = 0; k < 6; ++k) {
      const auto [row, column] = unknowns.list()[0].places(k).front();
      x[static_cast<std::size_t>(k)] = P(row, column);
    }
    const double floor = Eigen::SelfAdjointEigenSolver<expr::Matrix>(P).eigenvalues()(0);
    x.back() = floor * (1 - 1e-12);
    bool positive = true;
    for (const Block& block : bounds.blocks)
      positive &= Eigen::SelfAdjointEigenSolver<expr::Matrix>(block.value(x)).eigenvalues()(0) > 0;
    const model::GainBound reached = reached_bounds(bounds, x).front();
    EXPECT_EQ(positive, reached.reached < beta) << reached.reached;
    const expr::Values values = unknowns.values(x);
    const expr::Matrix gain = P.inverse() * values.at("Y");
    EXPECT_GE(reached.reached * (1 + 1e-9),
              Eigen::JacobiSVD<expr::Matrix>(gain).singularValues()(0));
    inside += positive ? 1 : 0;
  }
  EXPECT_GT(inside, 5);
  EXPECT_LT(inside, 195);
}

}  // namespace
}  // namespace gainsmith::lmi
