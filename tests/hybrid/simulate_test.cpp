#include "hybrid/simulate.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>

#include "base/error.h"
#include "hybrid/text_problem.h"
#include "support/linear_algebra.h"

namespace gainsmith::hybrid {
namespace {

using numbers::Matrix;
using Law = model::LawKind;
using Start = model::StartKind;
using tests::column;
using tests::sampled_data;
using tests::scalar;
using tests::TextProblem;

Arc simulate(TextProblem& problem, std::uint64_t seed = 1, std::uint64_t run = 0) {
  const model::Instance instance = problem.instance();
  const System system = make_system(instance, problem.gains);
  const Scenario scenario = make_scenario(*instance.design, system);
  const FlowSteps steps = make_steps(system);
  return Simulator(system, scenario, steps).run(seed, run);
}

TextProblem clock() {
  TextProblem problem;
  problem.state("x", "scalar").state("jumps", "scalar").flow({{"x", "1 + 0*x"}});
  problem.jump({{"jumps", "jumps + 1"}}).timer("0.5", "1.1", "0", "1.1");
  problem.start("x", Start::expression, {"0"}).start("jumps", Start::expression, {"0"});
  return problem;
}

TEST(Simulate, TimerIsSteppedToExactly) {
  TextProblem problem = clock();
  problem.first("0.3").horizon("50").law(Law::list, {"0.5", "0.7", "1.1"});
  const Arc arc = simulate(problem);
  EXPECT_EQ(arc.termination, Termination::horizon);
  double expected = 0.3;  // the time of the next jump
  std::size_t jumps = 0;
  for (std::size_t k = 0; k + 1 < arc.samples(); ++k) {
    EXPECT_GE(arc.timer[k], 0);
    if (!arc.moves[k].jump) {
      EXPECT_EQ(arc.j[k + 1], arc.j[k]);
      EXPECT_GT(arc.t[k + 1], arc.t[k]);
      continue;
    }
    EXPECT_EQ(arc.timer[k], 0);
    EXPECT_EQ(arc.t[k], expected);
    EXPECT_EQ(arc.t[k + 1], expected);
    EXPECT_EQ(arc.j[k + 1], arc.j[k] + 1);
    EXPECT_EQ(arc.state(k + 1)(1), static_cast<double>(jumps + 1));
    const double interval = (std::array{0.5, 0.7, 1.1})[jumps++ % 3];
    EXPECT_EQ(arc.timer[k + 1], interval);
    expected += interval;
  }
  EXPECT_EQ(jumps, 66U);  // 0.3 + 21 (0.5 + 0.7 + 1.1) + 0.5 + 0.7 < 50 < that + 1.1
  EXPECT_EQ(arc.t.back(), 50);
  EXPECT_NEAR(arc.state(arc.samples() - 1)(0), 50, 1e-12);
}

TEST(Simulate, FirstValueZeroIsAJumpAtTheStart) {
  TextProblem problem = clock();
  problem.first("0").horizon("0.25").law(Law::constant, {"0.5"});
  const Arc arc = simulate(problem);
  EXPECT_EQ(arc.t[0], 0);
  EXPECT_EQ(arc.t[1], 0);
  EXPECT_TRUE(arc.moves[0].jump);
  EXPECT_EQ(arc.j[1], 1);
  EXPECT_EQ(arc.timer[1], 0.5);
  EXPECT_EQ(arc.j.back(), 1);
  EXPECT_EQ(arc.t.back(), 0.25);
  EXPECT_EQ(arc.timer.back(), 0.25);
}

TEST(Simulate, JumpAtTheHorizonBelongsToTheRun) {
  TextProblem problem = clock();
  problem.first("0.5").horizon("1").law(Law::constant, {"0.5"});
  const Arc arc = simulate(problem);
  EXPECT_EQ(arc.t.back(), 1);
  EXPECT_EQ(arc.j.back(), 2);
}

TEST(Simulate, EachRunIsAFunctionOfSeedAndRun) {
  TextProblem problem = clock();
  problem.law(Law::uniform);
  const Arc a = simulate(problem, 7, 11);
  const Arc b = simulate(problem, 7, 11);
  EXPECT_EQ(a.stacked, b.stacked);
  EXPECT_EQ(a.t, b.t);
  EXPECT_NE(a.t, simulate(problem, 7, 12).t);
  EXPECT_NE(a.t, simulate(problem, 8, 11).t);
}

TEST(Simulate, DrawsComeInTheDocumentedOrder) {
  TextProblem problem;
  problem.state("z", "2").state("x", "scalar").timer("1", "2", "0", "3").law(Law::uniform);
  problem.start("x", Start::box, {"10", "20"});
  const Arc arc = simulate(problem, 5, 9);
  RandomStream draws(5, 9);
  for (int i = 0; i < 2; ++i) EXPECT_EQ(arc.state(0)(i), -1 + 2 * draws.uniform());
  EXPECT_EQ(arc.state(0)(2), 10 + 10 * draws.uniform());
  EXPECT_EQ(arc.timer[0], 3 * draws.uniform());
  for (std::size_t k = 0; k + 1 < arc.samples(); ++k)
    if (arc.moves[k].jump) {
      EXPECT_EQ(arc.timer[k + 1], 1 + draws.uniform());
    }
}

TEST(Simulate, StartsFromExpressionsAndLists) {
  TextProblem problem = sampled_data("1.1", column({0, 0}), column({0, 0}), scalar(0));
  problem.start("z", Start::list, {"[10, 0]", "[1, 2]"}).start("zh", Start::expression, {"[0, 0]"});
  problem.start("th", Start::expression, {"C*z"});
  const Arc first = simulate(problem, 1, 0);
  EXPECT_EQ(Eigen::VectorXd(first.state(0)), column({10, 0, 0, 0, 5}));
  const Arc second = simulate(problem, 1, 3);
  EXPECT_EQ(Eigen::VectorXd(second.state(0)), column({1, 2, 0, 0, -1.5}));
}

/// The flow matrix of Ferrante and Seuret 2021, (8), built from the paper's formula and not from
/// the simulated text.
Matrix error_flow(const Matrix& L, double H) {
  const Matrix A{{0.2, -1.01}, {1, 0}};
  const Matrix C{{0.5, -1}};
  Matrix phi(3, 3);
  const Matrix CL = tests::product({C, L});
  phi << A - tests::product({L, C}), L, tests::product({C, A}) - tests::product({CL, C}) - H * C,
      CL + scalar(H);
  return phi;
}

/// S(tau), from sample to sample (docs/theory/sampled-data.md).
Matrix sample_map(const Matrix& L, const Matrix& F, double H, double tau) {
  Matrix start = Matrix::Zero(3, 2);
  start.topRows(2) = Matrix::Identity(2, 2) - tests::product({F, Matrix{{0.5, -1}}});
  return tests::product({tests::exponential(error_flow(L, H) * tau), start}).topRows(2);
}

Eigen::Vector2d error(const Arc& arc, std::size_t k) {
  return arc.state(k).head(2) - arc.state(k).segment(2, 2);
}

double q(const Arc& arc, std::size_t k) {
  return Matrix{{0.5, -1}}.row(0).dot(error(arc, k)) - arc.state(k)(4);
}

TEST(SampledData, SamplesClearTheOutputErrorAndObeyTheSampleMap) {
  const Matrix L = column({3.68, -24.47});
  const Matrix F = column({0.104, -0.948});
  const double H = -25.93;
  TextProblem problem = sampled_data("1.1", L, F, scalar(H));
  problem.law(Law::uniform).horizon("20");
  const Arc arc = simulate(problem, 2, 3);
  const double scale = arc.states().cwiseAbs().maxCoeff();
  std::size_t checked = 0;
  std::optional<std::size_t> before;  // the sample before the previous jump
  for (std::size_t k = 0; k + 1 < arc.samples(); ++k) {
    if (!arc.moves[k].jump) continue;
    EXPECT_NEAR(q(arc, k + 1), 0, 1e-14 * scale);
    if (before) {
      const double tau = arc.timer[*before + 1];
      const Eigen::Vector2d expected =
          tests::product({sample_map(L, F, H, tau), error(arc, *before)});
      EXPECT_LT((error(arc, k) - expected).norm(), 1e-13 * scale);
      ++checked;
    }
    before = k;
  }
  EXPECT_GE(checked, 17U);
}

TEST(SampledData, ErrorFollowsEquationEightBetweenSamples) {
  const Matrix L = column({3.68, -24.47});
  TextProblem problem = sampled_data("1.1", L, column({0.1, -0.9}), scalar(-11.47));
  problem.first("1.1").horizon("1.1");
  const Arc arc = simulate(problem);
  Eigen::Vector3d start;
  start << error(arc, 0), q(arc, 0);
  for (std::size_t k = 1; k < arc.samples() && !arc.moves[k - 1].jump; ++k) {
    const Eigen::Vector3d expected =
        tests::product({tests::exponential(error_flow(L, -11.47) * arc.t[k]), start});
    EXPECT_LT((error(arc, k) - expected.head(2)).norm(), 1e-13);
    EXPECT_NEAR(q(arc, k), expected(2), 1e-12);
  }
}

/// The growth of the error per sample, from the last samples of a long run.
double growth(TextProblem problem) {
  problem.law(Law::constant, {"T2"}).first("T2").horizon("60*T2");
  const Arc arc = simulate(problem);
  std::vector<double> norms;
  for (std::size_t k = 0; k + 1 < arc.samples(); ++k)
    if (arc.moves[k].jump) norms.push_back(error(arc, k).norm());
  return std::pow(norms.back() / norms[norms.size() - 21], 1.0 / 20);
}

TEST(SampledData, RowThreeDivergesAtTheSpectralRadius) {
  const Matrix L = column({3.68, -24.47});
  const Matrix F = column({0.040, -0.364});
  const double radius = tests::eigenvalues(sample_map(L, F, -11.47, 1.1)).cwiseAbs().maxCoeff();
  EXPECT_NEAR(radius, 1.2062, 5e-5);
  EXPECT_NEAR(growth(sampled_data("1.1", L, F, scalar(-11.47))), radius, 1e-6);
}

TEST(SampledData, RowTwoContractsInItsNorm) {
  TextProblem problem =
      sampled_data("1.1", column({3.68, -24.47}), column({0.104, -0.948}), scalar(-25.93));
  problem.law(Law::uniform).law(Law::extremes).horizon("15");
  const Matrix Q{{5.697, -1.308}, {-1.308, 1.364}};
  for (std::uint64_t run = 0; run < 40; ++run) {
    const Arc arc = simulate(problem, 1, run);
    double before = -1;
    for (std::size_t k = 0; k + 1 < arc.samples(); ++k) {
      if (!arc.moves[k].jump) continue;
      const double norm = std::sqrt(error(arc, k).dot(tests::product({Q, error(arc, k)}).col(0)));
      if (before >= 0) {
        EXPECT_LE(norm, 0.7790 * before + 1e-12);  // 0.7789 with Q's four digits
      }
      before = norm;
    }
  }
}

TEST(Simulate, OverflowIsNamed) {
  TextProblem problem;
  problem.state("x", "scalar").flow({{"x", "x"}}).timer("1", "1", "1", "1").horizon("1000");
  problem.start("x", Start::expression, {"1"});
  const Arc arc = simulate(problem);
  EXPECT_EQ(arc.termination, Termination::diverged);
  EXPECT_NEAR(arc.t.back(), 150 * std::log(10), 0.2);
}

TEST(Simulate, JumpMapWithoutAValueIsNamed) {
  TextProblem problem;
  problem.state("x", "scalar").jump({{"x", "sqrt(x - 1.5)"}}).timer("1", "1", "1", "1");
  problem.start("x", Start::expression, {"2"});
  const Arc arc = simulate(problem);
  EXPECT_EQ(arc.termination, Termination::undefined);
  EXPECT_EQ(arc.j.back(), 1);
  EXPECT_NE(arc.message.find("sqrt"), std::string::npos) << arc.message;
}

TEST(Simulate, NonlinearJumpIsEvaluated) {
  TextProblem problem;
  problem.state("x", "scalar").jump({{"x", "x^2"}}).timer("1", "1", "1", "1").horizon("3");
  problem.start("x", Start::expression, {"2"});
  const Arc arc = simulate(problem);
  EXPECT_EQ(arc.state(arc.samples() - 1)(0), 256);
}

TEST(Simulate, IntervalsThatShrinkToNothingHitTheJumpLimit) {
  TextProblem problem;
  problem.state("x", "scalar").timer("0", "1", "0", "0").law(Law::constant, {"0"});
  const model::Instance instance = problem.instance();
  const System system = make_system(instance, problem.gains);
  Scenario scenario = make_scenario(*instance.design, system);
  scenario.jump_limit = 100;
  const FlowSteps steps = make_steps(system);
  const Arc arc = Simulator(system, scenario, steps).run(1, 0);
  EXPECT_EQ(arc.termination, Termination::jump_limit);
  EXPECT_EQ(arc.j.back(), 100);
  EXPECT_EQ(arc.t.back(), 0);
}

}  // namespace
}  // namespace gainsmith::hybrid
