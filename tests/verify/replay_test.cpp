#include "verify/replay.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "support/text_problem.h"
#include "verify/campaign.h"

namespace gainsmith::verify {
namespace {

using testing::ElementsAre;
using tests::column;
using tests::sampled_data;
using tests::scalar;
using tests::TextProblem;

TextProblem problem_with_claims() {
  TextProblem problem =
      sampled_data("1.1", column({3.68, -24.47}), column({0.104, -0.948}), scalar(-25.93));
  problem.horizon("5").runs(20).shrinks("small", "norm(e)", "0.9");
  problem.cost("J", "100*e'*e", "e'*e", "0.01*e'*e");
  return problem;
}

Replay replay(const TextProblem& problem, std::uint64_t seed, std::uint64_t run) {
  return replay_run(*make_setup(problem.instance(), problem.gains), seed, run, 0);
}

std::vector<std::string> names(const Replay& replay) {
  std::vector<std::string> result;
  for (const Column& column : replay.columns) result.push_back(column.name);
  return result;
}

Eigen::VectorXd column_of(const Replay& replay, const std::string& name) {
  const std::vector<std::string> all = names(replay);
  return replay.table.col(std::find(all.begin(), all.end(), name) - all.begin());
}

TEST(Replay, HasAColumnForEachThing) {
  const Replay result = replay(problem_with_claims(), 1, 4);
  EXPECT_THAT(names(result), ElementsAre("t", "j", "z1", "z2", "zh1", "zh2", "th", "tau", "e1",
                                         "e2", "q", "small", "J"));
  ASSERT_EQ(static_cast<std::size_t>(result.table.cols()), result.columns.size());
  const auto at = [&](const char* name) { return column_of(result, name); };
  EXPECT_EQ(Eigen::VectorXd(at("e1")), Eigen::VectorXd(at("z1") - at("zh1")));
  EXPECT_LT((at("q") - (0.5 * at("e1") - at("e2") - at("th"))).norm(), 1e-13);
  EXPECT_LT((at("small") - (at("e1").cwiseAbs2() + at("e2").cwiseAbs2()).cwiseSqrt()).norm(),
            1e-13);
}

/// A rotation keeps its norm: two integrations do not show it, and the matrix inequality does.
TEST(Replay, KnowsWhatIsProvedAsTheCampaignDoes) {
  TextProblem problem;
  problem.state("x", "2").flow({{"x", "[0, 1; -1, 0]*x"}}).timer("1", "1", "1", "1");
  problem.runs(5).horizon("10").nonincreasing("norm", "x'*x");
  EXPECT_EQ(run_campaign(*make_setup(problem.instance(), problem.gains)).verdict,
            model::CampaignVerdict::held);
  const claims::Finding finding = replay(problem, 1, 2).claims[0].finding;
  EXPECT_EQ(finding.judgement, claims::Judgement::held);
  EXPECT_EQ(finding.t, 10);
}

TEST(Replay, FindsWhatTheCampaignFound) {
  const TextProblem problem = problem_with_claims();
  const Report report = run_campaign(*make_setup(problem.instance(), problem.gains));
  for (std::size_t i = 0; i < report.checks.size(); ++i) {
    const CheckReport& check = report.checks[i];
    const Replay again = replay(problem, report.seed, check.worst_run);
    const claims::Finding& finding = again.claims[i].finding;
    EXPECT_EQ(again.claims[i].name, check.name);
    EXPECT_EQ(finding.judgement, check.worst.judgement);
    EXPECT_EQ(finding.score, check.worst.score);
    EXPECT_EQ(finding.value, check.worst.value);
    EXPECT_EQ(finding.bound, check.worst.bound);
    EXPECT_EQ(finding.t, check.worst.t);
    EXPECT_EQ(finding.j, check.worst.j);
  }
}

TEST(Replay, FunctionsAreThoseOfTheGainFile) {
  TextProblem problem;
  problem.unknown_function("W", {1, 2, -0.5}).gain_function("F", {0.5, -1, 3});
  problem.state("x", "scalar").jump({{"x", "F(0.25)*x"}}).timer("1", "1", "1", "1").horizon("2.5");
  problem.signals({{"w", "W(tau)"}}).nonincreasing("V", "W(tau)*x^2");
  problem.start("x", model::StartKind::expression, {"8"});
  const Replay result = replay(problem, 1, 0);
  const double factor = 0.5 - 0.25 + 3 * 0.25 * 0.25;
  const Eigen::VectorXd jumps = column_of(result, "j");
  for (Eigen::Index k = 0; k < result.table.rows(); ++k) {
    const double tau = column_of(result, "tau")(k);
    const double w = 1 + 2 * tau - 0.5 * tau * tau;
    const double x = 8 * std::pow(factor, jumps(k));
    EXPECT_DOUBLE_EQ(column_of(result, "x")(k), x);
    EXPECT_DOUBLE_EQ(column_of(result, "w")(k), w);
    EXPECT_DOUBLE_EQ(column_of(result, "V")(k), w * x * x);
  }
  EXPECT_EQ(jumps.tail(1)(0), 2);

  problem.gains.unknowns.clear();
  const Replay without = replay(problem, 1, 0);
  EXPECT_TRUE(without.claims.empty());
  EXPECT_THAT(names(without), ElementsAre("t", "j", "x", "tau"));
}

TEST(Replay, MatrixStatesAreNamedByRowAndColumn) {
  TextProblem problem;
  problem.state("M", "2 x 2").timer("1", "1", "1", "1").horizon("1");
  EXPECT_THAT(names(replay(problem, 1, 0)),
              ElementsAre("t", "j", "M1_1", "M2_1", "M1_2", "M2_2", "tau"));
}

/// The error decays to nothing while the plant grows: it ends as rounding, and is told from what is
/// none by how it moves with the last places.
TEST(Replay, KnowsWhatIsRounding) {
  TextProblem problem =
      sampled_data("1.1", column({3.68, -24.47}), column({0.104, -0.948}), scalar(-25.93));
  problem.horizon("200").runs(1).shrinks("small", "norm(e)", "0.9");
  const Replay result = table_of_run(*make_setup(problem.instance(), problem.gains), 1, 0, 0, true);
  ASSERT_EQ(result.rounding.rows(), result.table.rows());
  ASSERT_EQ(result.rounding.cols(), result.table.cols());
  const std::vector<std::string> all = names(result);
  const auto at = [&](const char* name) {
    return std::find(all.begin(), all.end(), name) - all.begin();
  };
  EXPECT_EQ(result.rounding.col(at("z1")).norm(), 0);
  EXPECT_LT(result.rounding(0, at("small")), 1e-12 * result.table(0, at("small")));
  int late = 0, rounding = 0;
  for (Eigen::Index row = 0; row < result.table.rows(); ++row) {
    if (result.table(row, 0) < 150) continue;
    ++late;
    rounding += std::abs(result.table(row, at("e1"))) <= result.rounding(row, at("e1")) ? 1 : 0;
  }
  EXPECT_GT(late, 100);
  EXPECT_GT(rounding, 0.9 * late);
  EXPECT_EQ(replay(problem, 1, 0).rounding.size(), 0);
}

}  // namespace
}  // namespace gainsmith::verify
