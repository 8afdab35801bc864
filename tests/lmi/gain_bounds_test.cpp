#include "lmi/gain_bounds.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <random>

#include "support/linear_algebra.h"
#include "support/yaml_problem.h"

namespace gainsmith::lmi {
namespace {

std::string with_gains(const std::string& gains) {
  return "problem: p\nmethod:\n  method: m\n  data: {A: n x n, C: p x n}\n"
         "  unknowns: {P: symmetric n, Q: symmetric p, Y: n x p, Z: p x n, K: p x n}\n"
         "  require: {positive: P > 0}\n  gains: {" +
         gains +
         "}\n"
         "data: {A: [[0, 1, 0], [0, 0, 1], [1, 0, 0]], C: [[1, 0, 0], [0, 1, 0]]}\n";
}

std::vector<std::string> names(const GainBounds& bounds) {
  std::vector<std::string> result;
  for (const BoundedProduct& bound : bounds.list) result.push_back(bound.what);
  return result;
}

TEST(GainBoundsTest, EveryProductWithAnInverseIsFoundOnce) {
  const tests::YamlProblem yaml(with_gains(
      "L: inv(P)*Y, M: 3*inv(P)*Y, H: inv(Q)*(Z*A + Z) - C*inv(P)*Y*C, G: Z*inv(P), K: K"));
  const GainBounds bounds = gain_bounds(Inequalities(yaml.instance), 100);
  EXPECT_EQ(names(bounds), (std::vector<std::string>{"inv(P)*Y", "inv(Q)*(Z*A + Z)", "inv(P)*Y*C",
                                                     "Z*inv(P)", "K"}));
  EXPECT_EQ(bounds.scalars, 2);
}

/// A 1 x 1 unknown is symmetric, whatever it is declared as.
TEST(GainBoundsTest, ScalarsAreBoundedAlike) {
  for (const char* kind : {"scalar", "symmetric 1", "1 x 1"}) {
    const tests::YamlProblem yaml(
        std::string("problem: p\nmethod:\n  method: m\n  unknowns: {P: ") + kind +
        ", Y: scalar}\n  require: {p: P > 0}\n  gains: {L: inv(P)*Y}\n");
    EXPECT_EQ(names(gain_bounds(Inequalities(yaml.instance), 100)),
              std::vector<std::string>{"inv(P)*Y"})
        << kind;
  }
}

/// What two gains share keeps the smaller bound; gains that are not named have none.
TEST(GainBoundsTest, GainsMayHaveBoundsOfTheirOwn) {
  const tests::YamlProblem yaml(
      with_gains("L: inv(P)*Y, M: inv(P)*Y - K', G: Z*inv(P), N: inv(Q)*Z") +
      "synthesis: {gain_bound: {L: 200, M: 5, G: 0.1}}\n");
  const GainBounds bounds = gain_bounds(Inequalities(yaml.instance), 200);
  EXPECT_EQ(names(bounds), (std::vector<std::string>{"inv(P)*Y", "inv(P)*Y", "Z*inv(P)"}));
  EXPECT_EQ(bounds.beta, 200);
  EXPECT_DOUBLE_EQ(200 * bounds.list[0].share, 200);
  EXPECT_DOUBLE_EQ(200 * bounds.list[1].share, 5);
  EXPECT_DOUBLE_EQ(200 * bounds.list[2].share, 0.1);
  const std::vector<model::GainBound> reached = reached_bounds(
      bounds, std::vector<double>(Inequalities(yaml.instance).unknowns.size() + 2, 0.0));
  EXPECT_DOUBLE_EQ(reached[2].bound, 0.1);
}

TEST(GainBoundsTest, TheWholeProductAndAffineGainsAreBounded) {
  const tests::YamlProblem yaml(with_gains("L: inv(P)*C'*Q*2, M: 2*K + K, N: inv(P)*Y*inv(Q)"));
  const GainBounds bounds = gain_bounds(Inequalities(yaml.instance), 100);
  EXPECT_EQ(names(bounds),
            (std::vector<std::string>{"inv(P)*C'*Q*2", "(2*K + K)", "inv(P)*Y", "Y*inv(Q)"}));
}

TEST(GainBoundsTest, FunctionsAreBoundedCoefficientByCoefficient) {
  const std::string text =
      "problem: p\nmethod:\n  method: m\n  data: {C: p x n}\n"
      "  unknowns: {P: symmetric n, Y: {shape: n x p, of: t, degree: 2}, X: {shape: n x p, of: "
      "t}}\n"
      "  require: {positive: P > 0}\n"
      "  gains: {L(t): inv(P)*Y(t), M(t): X(t) + t*Y(0), N(s): inv(P)*(exp(-s)*X(s) + C'*s)}\n"
      "data: {C: [[1, 2]]}\n";
  const tests::YamlProblem yaml(text);
  const GainBounds bounds = gain_bounds(Inequalities(yaml.instance), 100);
  EXPECT_EQ(names(bounds),
            (std::vector<std::string>{"inv(P)*Y_0", "inv(P)*Y_1", "inv(P)*Y_2", "(X_0 + t*Y_0)",
                                      "(X_0 + t*Y_0)*t", "(X_0 + t*Y_1)*t", "(X_0 + t*Y_2)*t",
                                      "inv(P)*(exp(-s)*X_0 + C'*s)*s",
                                      "inv(P)*(exp(-s)*X_0 + C'*s)*exp(-1*s)"}));
  // P, Y_0, Y_1, Y_2, X_0, s: with P = 4 I the largest singular values count.
  const std::vector<double> x = {4, 0, 4, 3, 4, 30, 40, 300, 400, 6, 8, 4};
  const auto reached = reached_bounds(bounds, x);
  const double expected[] = {5. / 4, 50. / 4, 500. / 4, 10, 5, 50, 500, std::sqrt(5.) / 4, 10. / 4};
  for (std::size_t i = 0; i < reached.size(); ++i)
    EXPECT_NEAR(reached[i].reached, expected[i], 1e-11 * expected[i]) << reached[i].what;
}

/// Coefficients of Chebyshev polynomials, and of what is inverted, bound nothing.
TEST(GainBoundsTest, InversesOfFunctionsAreBoundedAtPoints) {
  const tests::YamlProblem yaml(
      "problem: p\nmethod:\n  method: m\n  unknowns:\n"
      "    P: {shape: symmetric 2, of: s, in: [0, 2], degree: 1}\n"
      "    Y: {shape: 2 x 1, of: s, in: [0, 2], degree: 1}\n"
      "  require: {positive: {forall: \"s in [0, 2]\", that: P(s) > 0}}\n"
      "  gains: {L(s): inv(P(s))*Y(s), F: inv(P(0))*Y(2)}\n");
  const GainBounds bounds = gain_bounds(Inequalities(yaml.instance), 100);
  EXPECT_EQ(names(bounds),
            (std::vector<std::string>{"inv(P(s))*Y(s) at s = 0", "inv(P(s))*Y(s) at s = 1",
                                      "inv(P(s))*Y(s) at s = 2", "inv(P(0))*Y(2)"}));
  // P = (2 + (s - 1)) I, Y = [1; 0] + 3 (s - 1) [1; 0].
  const auto reached = reached_bounds(bounds, {2, 0, 2, 1, 0, 1, 1, 0, 3, 0});
  const double expected[] = {2, 1. / 2, 4. / 3, 4};
  for (std::size_t i = 0; i < reached.size(); ++i)
    EXPECT_NEAR(reached[i].reached, expected[i], 1e-11 * expected[i]) << reached[i].what;
}

/// A call in a definition is no part of the gain's text, which may have spaces.
TEST(GainBoundsTest, CallsMayStandInDefinitions) {
  const tests::YamlProblem yaml(
      "problem: p\nmethod:\n  method: m\n  unknowns: {P: symmetric 2, Y: {shape: 2 x 1, of: t, "
      "degree: 1}}\n  let: {S(a): 2*Y(a)}\n  require: {positive: P > 0}\n"
      "  gains: {L(t): S(t), M(t): inv(P)*S(3*t), N(t): inv(P)*Y (t)}\n");
  const GainBounds bounds = gain_bounds(Inequalities(yaml.instance), 100);
  EXPECT_EQ(names(bounds),
            (std::vector<std::string>{"S(t)", "S(t)*t", "inv(P)*S(3*t)", "inv(P)*S(3*t)*t",
                                      "inv(P)*Y_0", "inv(P)*Y_1"}));
  // P = I, Y = 1 + 4 t in its first element.
  const auto reached = reached_bounds(bounds, {1, 0, 1, 1, 0, 4, 0, 1});
  const double expected[] = {2, 8, 2, 24, 1, 4};
  for (std::size_t i = 0; i < reached.size(); ++i)
    EXPECT_NEAR(reached[i].reached, expected[i], 1e-11 * std::max(1.0, expected[i]))
        << reached[i].what;
}

TEST(GainBoundsTest, AnEmptyGainNeedsNoBound) {
  const tests::YamlProblem yaml(with_gains("L: \"inv(P)*Y*zeros(p, 0)\""));
  EXPECT_TRUE(gain_bounds(Inequalities(yaml.instance), 100).list.empty());
}

TEST(GainBoundsTest, NoBoundNoBlocks) {
  const tests::YamlProblem yaml(with_gains("L: inv(P)*Y"));
  EXPECT_TRUE(gain_bounds(Inequalities(yaml.instance), std::nullopt).blocks.empty());
}

/// Random unknowns: the blocks are positive for some s exactly when the measure that is reported is
/// below beta, and the measure is never below the gain's norm.
TEST(GainBoundsTest, BlocksSayTheSameAsTheMeasure) {
  const tests::YamlProblem yaml(with_gains("L: inv(P)*Y"));
  const Inequalities inequalities(yaml.instance);
  const Unknowns& unknowns = inequalities.unknowns;
  const double beta = 3;
  const GainBounds bounds = gain_bounds(inequalities, beta);
  std::mt19937 generator(3);
  std::normal_distribution<double> number;
  int inside = 0;
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<double> x(static_cast<std::size_t>(unknowns.size()) + 1);
    for (double& value : x) value = number(generator);
    const numbers::Matrix root =
        numbers::Matrix::NullaryExpr(3, 3, [&] { return number(generator); });
    const numbers::Matrix P =
        tests::product({root, root.transpose()}) + 0.1 * numbers::Matrix::Identity(3, 3);
    for (int k = 0; k < 6; ++k) {
      const auto [row, column] = unknowns.list()[0].places(k).front();
      x[static_cast<std::size_t>(k)] = P(row, column);
    }
    const double floor = tests::symmetric_eigenvalues(P)(0);
    x.back() = floor * (1 - 1e-12);
    bool positive = true;
    for (const Block& block : bounds.blocks)
      positive &= tests::symmetric_eigenvalues(block.value(x))(0) > 0;
    const model::GainBound reached = reached_bounds(bounds, x).front();
    EXPECT_EQ(positive, reached.reached < beta) << reached.reached;
    const numbers::Values values = unknowns.values(x);
    const numbers::Matrix gain = tests::product({tests::inverse(P), values.at("Y")});
    EXPECT_GE(reached.reached * (1 + 1e-9), tests::singular_values(gain)(0));
    inside += positive ? 1 : 0;
  }
  EXPECT_GT(inside, 5);
  EXPECT_LT(inside, 195);
}

/// Of an M that is not symmetric the block is sufficient, and the measure is the gain's norm; with
/// M = m I, s = m it is necessary too.
TEST(GainBoundsTest, InversesThatAreNotSymmetricAreBounded) {
  const tests::YamlProblem yaml(
      "problem: p\nmethod:\n  method: m\n  unknowns: {M: 3 x 3, Y: 3 x 2, Z: 2 x 3}\n"
      "  require: {positive: He(M) > 0, y: \"[I, Y; *, I] > 0\", z: \"[I, Z; *, I] > 0\"}\n"
      "  gains: {L: inv(M)*Y, K: Z*inv(M)}\n");
  const Inequalities inequalities(yaml.instance);
  const Unknowns& unknowns = inequalities.unknowns;
  const double beta = 2;
  const GainBounds bounds = gain_bounds(inequalities, beta);
  EXPECT_EQ(names(bounds), (std::vector<std::string>{"inv(M)*Y", "Z*inv(M)"}));
  ASSERT_EQ(bounds.blocks.size(), 2U);
  std::mt19937 generator(4);
  std::normal_distribution<double> number;
  int inside = 0;
  for (int trial = 0; trial < 400; ++trial) {
    std::vector<double> x(static_cast<std::size_t>(unknowns.size()) + 1);
    for (double& value : x) value = 0.5 * number(generator);
    const bool multiple = trial % 2 == 0;
    for (std::size_t k = 0; k < 9; ++k) x[k] = (multiple ? 0 : x[k]) + (k % 4 == 0 ? 1 : 0);
    x.back() = 1;
    const numbers::Values values = unknowns.values(x);
    const numbers::Matrix inverse = tests::inverse(values.at("M"));
    const numbers::Matrix gains[] = {tests::product({inverse, values.at("Y")}),
                                     tests::product({values.at("Z"), inverse})};
    const auto reached = reached_bounds(bounds, x);
    for (std::size_t k = 0; k < 2; ++k) {
      const double norm = tests::singular_values(gains[k])(0);
      EXPECT_NEAR(reached[k].reached, norm, 1e-9 * norm);
      const bool positive = tests::symmetric_eigenvalues(bounds.blocks[k].value(x))(0) > 0;
      EXPECT_TRUE(!positive || norm <= beta) << norm;
      EXPECT_TRUE(!multiple || positive == (norm < beta)) << norm;
      inside += positive ? 1 : 0;
    }
  }
  EXPECT_GT(inside, 20);
  EXPECT_LT(inside, 780);
}

}  // namespace
}  // namespace gainsmith::lmi
