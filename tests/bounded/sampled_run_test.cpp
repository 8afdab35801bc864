// Runs of sampled dynamics: draws, lengths, flows and jumps, and against the careful simulator.
#include "bounded/bounded_run.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>

#include "base/error.h"
#include "bounded/sampled_problem.h"
#include "simulate/simulator.h"
#include "support/linear_algebra.h"

namespace gainsmith::bounded {
namespace {

using numbers::Matrix;
using Law = model::LawKind;
using Start = model::StartKind;
using tests::column;
using tests::sampled_data;
using tests::scalar;
using tests::TextProblem;

Track<double> simulate(TextProblem& problem, std::uint64_t seed = 1, std::uint64_t run = 0) {
  const SampledProblem made(problem);
  const Coordinates states = made.states();
  const BoundedSystem<double> bounded(states, exact_steps(states, *made.steps, {}));
  return BoundedSimulator<double>(made.system(), made.scenario, *made.steps, bounded)
      .run(seed, run);
}

double largest(const Track<double>& run) {
  double size = 0;
  for (const double x : run.stacked) size = std::max(size, std::abs(x));
  return size;
}

TextProblem clock() {
  TextProblem problem;
  problem.state("x", "scalar").state("jumps", "scalar").flow({{"x", "1 + 0*x"}});
  problem.jump({{"jumps", "jumps + 1"}}).timer("0.5", "1.1", "0", "1.1");
  problem.start("x", Start::expression, {"0"}).start("jumps", Start::expression, {"0"});
  return problem;
}

TEST(SampledRun, TimerIsSteppedToExactly) {
  TextProblem problem = clock();
  problem.first("0.3").horizon("50").law(Law::list, {"0.5", "0.7", "1.1"});
  const Track<double> arc = simulate(problem);
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

TEST(SampledRun, FirstValueZeroIsAJumpAtTheStart) {
  TextProblem problem = clock();
  problem.first("0").horizon("0.25").law(Law::constant, {"0.5"});
  const Track<double> arc = simulate(problem);
  EXPECT_EQ(arc.t[0], 0);
  EXPECT_EQ(arc.t[1], 0);
  EXPECT_TRUE(arc.moves[0].jump);
  EXPECT_EQ(arc.j[1], 1);
  EXPECT_EQ(arc.timer[1], 0.5);
  EXPECT_EQ(arc.j.back(), 1);
  EXPECT_EQ(arc.t.back(), 0.25);
  EXPECT_EQ(arc.timer.back(), 0.25);
}

TEST(SampledRun, JumpAtTheHorizonBelongsToTheRun) {
  TextProblem problem = clock();
  problem.first("0.5").horizon("1").law(Law::constant, {"0.5"});
  const Track<double> arc = simulate(problem);
  EXPECT_EQ(arc.t.back(), 1);
  EXPECT_EQ(arc.j.back(), 2);
}

TEST(SampledRun, EachRunIsAFunctionOfSeedAndRun) {
  TextProblem problem = clock();
  problem.law(Law::uniform);
  const Track<double> a = simulate(problem, 7, 11);
  const Track<double> b = simulate(problem, 7, 11);
  EXPECT_EQ(a.stacked, b.stacked);
  EXPECT_EQ(a.t, b.t);
  EXPECT_NE(a.t, simulate(problem, 7, 12).t);
  EXPECT_NE(a.t, simulate(problem, 8, 11).t);
}

TEST(SampledRun, DrawsAreThoseOfTheirPurposes) {
  TextProblem problem;
  problem.state("z", "2").state("x", "scalar").timer("1", "2", "0", "3").law(Law::uniform);
  problem.start("x", Start::box, {"10", "20"});
  const Track<double> arc = simulate(problem, 5, 9);
  RandomStream z = hybrid::draw_stream(5, 9, hybrid::Purpose::start, 0);
  for (int i = 0; i < 2; ++i) EXPECT_EQ(arc.state(0)(i), -1 + 2 * z.uniform());
  EXPECT_EQ(arc.state(0)(2),
            10 + 10 * hybrid::draw_stream(5, 9, hybrid::Purpose::start, 1).uniform());
  EXPECT_EQ(arc.timer[0], 3 * hybrid::draw_stream(5, 9, hybrid::Purpose::first, 0).uniform());
  RandomStream lengths = hybrid::draw_stream(5, 9, hybrid::Purpose::length, 0);
  for (std::size_t k = 0; k + 1 < arc.samples(); ++k)
    if (arc.moves[k].jump) {
      EXPECT_EQ(arc.timer[k + 1], 1 + lengths.uniform());
    }
}

TEST(SampledRun, StartsFromExpressionsAndLists) {
  TextProblem problem = sampled_data("1.1", column({0, 0}), column({0, 0}), scalar(0));
  problem.start("z", Start::list, {"[10, 0]", "[1, 2]"}).start("zh", Start::expression, {"[0, 0]"});
  problem.start("th", Start::expression, {"C*z"});
  const Track<double> first = simulate(problem, 1, 0);
  EXPECT_EQ(Eigen::VectorXd(first.state(0)), column({10, 0, 0, 0, 5}));
  const Track<double> second = simulate(problem, 1, 3);
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

Eigen::Vector2d error(const Track<double>& arc, std::size_t k) {
  return arc.state(k).head(2) - arc.state(k).segment(2, 2);
}

double q(const Track<double>& arc, std::size_t k) {
  return Matrix{{0.5, -1}}.row(0).dot(error(arc, k)) - arc.state(k)(4);
}

TEST(SampledData, SamplesClearTheOutputErrorAndObeyTheSampleMap) {
  const Matrix L = column({3.68, -24.47});
  const Matrix F = column({0.104, -0.948});
  const double H = -25.93;
  TextProblem problem = sampled_data("1.1", L, F, scalar(H));
  problem.law(Law::uniform).horizon("20");
  const Track<double> arc = simulate(problem, 2, 3);
  const double scale = largest(arc);
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
  const Track<double> arc = simulate(problem);
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
  const Track<double> arc = simulate(problem);
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
    const Track<double> arc = simulate(problem, 1, run);
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

TEST(SampledRun, OverflowIsNamed) {
  TextProblem problem;
  problem.state("x", "scalar").flow({{"x", "x"}}).timer("1", "1", "1", "1").horizon("1000");
  problem.start("x", Start::expression, {"1"});
  const Track<double> arc = simulate(problem);
  EXPECT_EQ(arc.termination, Termination::diverged);
  EXPECT_NEAR(arc.t.back(), 150 * std::log(10), 0.2);
}

TEST(SampledRun, JumpMapWithoutAValueIsNamed) {
  TextProblem problem;
  problem.state("x", "scalar").jump({{"x", "sqrt(x - 1.5)"}}).timer("1", "1", "1", "1");
  problem.start("x", Start::expression, {"2"});
  const Track<double> arc = simulate(problem);
  EXPECT_EQ(arc.termination, Termination::undefined);
  EXPECT_EQ(arc.j.back(), 1);
  EXPECT_NE(arc.message.find("sqrt"), std::string::npos) << arc.message;
}

TEST(SampledRun, NonlinearJumpIsEvaluated) {
  TextProblem problem;
  problem.state("x", "scalar").jump({{"x", "x^2"}}).timer("1", "1", "1", "1").horizon("3");
  problem.start("x", Start::expression, {"2"});
  const Track<double> arc = simulate(problem);
  EXPECT_EQ(arc.state(arc.samples() - 1)(0), 256);
}

TEST(SampledRun, IntervalsThatShrinkToNothingHitTheJumpLimit) {
  TextProblem problem;
  problem.state("x", "scalar").timer("0", "1", "0", "0").law(Law::constant, {"0"});
  const Track<double> arc = simulate(problem);
  EXPECT_EQ(arc.termination, Termination::jump_limit);
  EXPECT_EQ(arc.j.back(), kMostJumps);
  EXPECT_EQ(arc.t.back(), 0);
}

/// The same draws, the same jumps: two simulators that share the texts alone.
TEST(SampledRun, IsTheRunOfTheCarefulSimulator) {
  TextProblem problem =
      sampled_data("1.1", column({3.68, -24.47}), column({0.104, -0.948}), scalar(-25.93));
  problem.horizon("20");
  const SampledProblem made(problem);
  simulate::Simulator careful(made.dynamics, made.scenario);
  for (std::uint64_t run = 0; run < 10; ++run) {
    const Track<double> arc = simulate(problem, 7, run);
    const hybrid::Trajectory trajectory = careful.run(7, run);
    EXPECT_EQ(trajectory.start.head(arc.size), Eigen::VectorXd(arc.state(0)));
    std::size_t k = 0;
    for (const auto& part : trajectory.parts) {
      const auto* jump = std::get_if<hybrid::JumpPoint>(&part);
      if (jump == nullptr) continue;
      while (!arc.moves.at(k).jump) ++k;
      EXPECT_NEAR(arc.t[k], jump->t, 1e-14 * jump->t);
      const double size = largest(arc);
      EXPECT_LT((jump->before.head(arc.size) - arc.state(k)).norm(), 1e-11 * size);
      EXPECT_LT((jump->after.head(arc.size) - arc.state(k + 1)).norm(), 1e-11 * size);
      ++k;
    }
    EXPECT_GT(k, 15U);
  }
}

}  // namespace
}  // namespace gainsmith::bounded
