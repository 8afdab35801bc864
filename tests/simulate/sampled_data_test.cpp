// Runs of the observer of Ferrante and Seuret 2021 against the formulas of the paper, and what runs
// of a plant with a timer are made of.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <variant>
#include <vector>

#include "bind/stated.h"
#include "simulate/simulator.h"
#include "support/event_problem.h"
#include "support/linear_algebra.h"
#include "support/text_problem.h"

namespace gainsmith::simulate {
namespace {

using hybrid::FlowPiece;
using hybrid::JumpPoint;
using hybrid::Trajectory;
using numbers::Matrix;
using Law = model::LawKind;
using Start = model::StartKind;
using tests::column;
using tests::jumps_of;
using tests::sampled_data;
using tests::scalar;
using tests::TextProblem;

Trajectory run_of(const TextProblem& problem, std::uint64_t seed = 1, std::uint64_t run = 0) {
  const model::Instance instance = problem.instance();
  const model::RunTexts texts = bind::run_texts(instance, problem.gains);
  const hybrid::System system = hybrid::make_system(texts.dynamics, texts.stated.values);
  const hybrid::Scenario scenario = hybrid::make_scenario(texts.campaign, system);
  return Simulator(system, scenario).run(seed, run);
}

/// The flow matrix, (8), built from the paper's formula and not from the simulated text.
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

Eigen::Vector2d error(const Eigen::VectorXd& x) { return x.head(2) - x.segment(2, 2); }

double q(const Eigen::VectorXd& x) { return Matrix{{0.5, -1}}.row(0).dot(error(x)) - x(4); }

TEST(SampledData, SamplesClearTheOutputErrorAndObeyTheSampleMap) {
  const Matrix L = column({3.68, -24.47});
  const Matrix F = column({0.104, -0.948});
  const double H = -25.93;
  TextProblem problem = sampled_data("1.1", L, F, scalar(H));
  problem.law(Law::uniform).horizon("20");
  const std::vector<JumpPoint> jumps = jumps_of(run_of(problem, 2, 3));
  ASSERT_GE(jumps.size(), 18U);
  for (std::size_t k = 0; k < jumps.size(); ++k) {
    const double scale = jumps[k].before.head(5).cwiseAbs().maxCoeff();
    EXPECT_NEAR(q(jumps[k].after), 0, 1e-14 * scale);
    if (k == 0) continue;
    const Matrix map = sample_map(L, F, H, jumps[k].t - jumps[k - 1].t);
    const Eigen::Vector2d expected = tests::product({map, error(jumps[k - 1].before)});
    EXPECT_LT((error(jumps[k].before) - expected).norm(), 1e-12 * scale);
  }
}

TEST(SampledData, ErrorFollowsEquationEightBetweenSamples) {
  const Matrix L = column({3.68, -24.47});
  TextProblem problem = sampled_data("1.1", L, column({0.1, -0.9}), scalar(-11.47));
  problem.first("1.1").horizon("1.1");
  const Trajectory run = run_of(problem);
  Eigen::Vector3d start;
  start << error(run.start), q(run.start);
  for (const hybrid::DenseStep& step : std::get<FlowPiece>(run.parts.front()).steps) {
    const Eigen::VectorXd x = step(step.to);
    const Eigen::Vector3d expected =
        tests::product({tests::exponential(error_flow(L, -11.47) * step.to), start});
    EXPECT_LT((error(x) - expected.head(2)).norm(), 1e-12);
    EXPECT_NEAR(q(x), expected(2), 1e-12);
  }
}

TEST(SampledData, RowThreeDivergesAtTheSpectralRadius) {
  const Matrix L = column({3.68, -24.47});
  const Matrix F = column({0.040, -0.364});
  const double radius = tests::eigenvalues(sample_map(L, F, -11.47, 1.1)).cwiseAbs().maxCoeff();
  EXPECT_NEAR(radius, 1.2062, 5e-5);
  TextProblem problem = sampled_data("1.1", L, F, scalar(-11.47));
  problem.law(Law::constant, {"T2"}).first("T2").horizon("60*T2");
  std::vector<double> norms;
  for (const JumpPoint& jump : jumps_of(run_of(problem)))
    norms.push_back(error(jump.before).norm());
  EXPECT_NEAR(std::pow(norms.back() / norms[norms.size() - 21], 1.0 / 20), radius, 1e-6);
}

TEST(SampledData, RowTwoContractsInItsNorm) {
  TextProblem problem =
      sampled_data("1.1", column({3.68, -24.47}), column({0.104, -0.948}), scalar(-25.93));
  problem.law(Law::uniform).law(Law::extremes).horizon("15");
  const Matrix Q{{5.697, -1.308}, {-1.308, 1.364}};
  for (std::uint64_t run = 0; run < 40; ++run) {
    double before = -1;
    for (const JumpPoint& jump : jumps_of(run_of(problem, 1, run))) {
      const Eigen::Vector2d e = error(jump.before);
      const double norm = std::sqrt(e.dot(tests::product({Q, e}).col(0)));
      if (before >= 0) {
        EXPECT_LE(norm, 0.7790 * before + 1e-12);  // 0.7789 with Q's four digits
      }
      before = norm;
    }
  }
}

TEST(SampledData, StartsFromExpressionsAndLists) {
  TextProblem problem = sampled_data("1.1", column({0, 0}), column({0, 0}), scalar(0));
  problem.start("z", Start::list, {"[10, 0]", "[1, 2]"}).start("zh", Start::expression, {"[0, 0]"});
  problem.start("th", Start::expression, {"C*z"});
  EXPECT_EQ(Matrix(run_of(problem, 1, 0).start.head(5)), column({10, 0, 0, 0, 5}));
  EXPECT_EQ(Matrix(run_of(problem, 1, 3).start.head(5)), column({1, 2, 0, 0, -1.5}));
}

TextProblem clock() {
  TextProblem problem;
  problem.state("x", "scalar").state("jumps", "scalar").flow({{"x", "1 + 0*x"}});
  problem.jump({{"jumps", "jumps + 1"}}).timer("0.5", "1.1", "0", "1.1");
  problem.start("x", Start::expression, {"0"}).start("jumps", Start::expression, {"0"});
  return problem;
}

TEST(TimerRun, JumpsWhereTheTimerHasRunDown) {
  TextProblem problem = clock();
  problem.first("0.3").horizon("50").law(Law::list, {"0.5", "0.7", "1.1"});
  const Trajectory run = run_of(problem);
  double expected = 0.3;
  std::size_t jumps = 0;
  for (const JumpPoint& jump : jumps_of(run)) {
    EXPECT_EQ(jump.t, expected);
    EXPECT_EQ(jump.after(1), static_cast<double>(jumps + 1));
    expected += (std::array{0.5, 0.7, 1.1})[jumps++ % 3];
  }
  EXPECT_EQ(jumps, 66U);  // 0.3 + 21 (0.5 + 0.7 + 1.1) + 0.5 + 0.7 < 50 < that + 1.1
  EXPECT_EQ(run.end, 50);
}

TEST(TimerRun, AFirstTimeOfZeroIsAJumpAtTheStart) {
  TextProblem problem = clock();
  problem.first("0").horizon("0.25").law(Law::constant, {"0.5"});
  const std::vector<JumpPoint> jumps = jumps_of(run_of(problem));
  ASSERT_EQ(jumps.size(), 1U);
  EXPECT_EQ(jumps.front().t, 0);
}

TEST(TimerRun, AJumpAtTheHorizonBelongsToTheRun) {
  TextProblem problem = clock();
  problem.first("0.5").horizon("1").law(Law::constant, {"0.5"});
  EXPECT_EQ(jumps_of(run_of(problem)).size(), 2U);
}

TEST(TimerRun, DrawsAreThoseOfTheirPurposes) {
  TextProblem problem;
  problem.state("z", "2").state("x", "scalar").timer("1", "2", "0", "3").law(Law::uniform);
  problem.start("x", Start::box, {"10", "20"});
  const Trajectory run = run_of(problem, 5, 9);
  RandomStream z = hybrid::draw_stream(5, 9, hybrid::Purpose::start, 0);
  for (int i = 0; i < 2; ++i) EXPECT_EQ(run.start(i), -1 + 2 * z.uniform());
  EXPECT_EQ(run.start(2), 10 + 10 * hybrid::draw_stream(5, 9, hybrid::Purpose::start, 1).uniform());
  double due = 3 * hybrid::draw_stream(5, 9, hybrid::Purpose::first, 0).uniform();
  RandomStream lengths = hybrid::draw_stream(5, 9, hybrid::Purpose::length, 0);
  for (const JumpPoint& jump : jumps_of(run)) {
    EXPECT_EQ(jump.t, due);
    due += 1 + lengths.uniform();
  }
}

}  // namespace
}  // namespace gainsmith::simulate
