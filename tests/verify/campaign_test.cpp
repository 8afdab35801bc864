#include "verify/campaign.h"

#include <gtest/gtest.h>

#include <cmath>
#include <thread>

#include "base/error.h"
#include "base/progress.h"
#include "support/stop.h"
#include "support/text_problem.h"
#include "verify/replay.h"

namespace gainsmith::verify {
namespace {

using model::CampaignVerdict;
using model::LawKind;
using model::StartKind;
using tests::column;
using tests::sampled_data;
using tests::scalar;
using tests::TextProblem;

// The shape in which row II contracts by 0.7789 per sample (docs/theory/sampled-data.md).
constexpr const char* kShape = "[5.697, -1.308; -1.308, 1.364]";

TextProblem row_two() {
  return sampled_data("1.1", column({3.68, -24.47}), column({0.104, -0.948}), scalar(-25.93));
}

TextProblem row_three() {
  return sampled_data("1.1", column({3.68, -24.47}), column({0.040, -0.364}), scalar(-11.47));
}

Replay replay(const model::Instance& instance, const model::Gains& gains, std::uint64_t seed,
              std::uint64_t run) {
  return replay_run(*make_setup(instance, gains), seed, run, 0);
}

Report run(TextProblem& problem, CampaignOptions options = {}) {
  return run_campaign(*make_setup(problem.instance(), problem.gains), options);
}

bool same(const Report& a, const Report& b) {
  bool equal = a.verdict == b.verdict && a.violations == b.violations &&
               a.worst_run == b.worst_run && a.checks.size() == b.checks.size();
  for (std::size_t i = 0; equal && i < a.checks.size(); ++i) {
    const claims::Finding& x = a.checks[i].worst;
    const claims::Finding& y = b.checks[i].worst;
    equal = x.score == y.score && x.value == y.value && x.bound == y.bound && x.t == y.t &&
            x.j == y.j && a.checks[i].worst_run == b.checks[i].worst_run &&
            a.checks[i].violations == b.checks[i].violations;
  }
  return equal;
}

TEST(Campaign, PublishedRowTwoShrinksItsErrorInEveryRun) {
  TextProblem problem = row_two();
  problem.runs(200).horizon("20").shrinks("shrinks", "norm(e)", "0.01");
  const Report report = run(problem);
  EXPECT_EQ(report.verdict, CampaignVerdict::held);
  EXPECT_EQ(report.violations, 0U);
  EXPECT_EQ(report.runs, 200U);
  EXPECT_LT(report.checks[0].worst.score, 0);
  EXPECT_NEAR(report.violation_probability, 1 - std::pow(0.05, 1.0 / 200), 1e-15);
}

TEST(Campaign, PublishedRowThreeIsCaughtAtTheLongestInterval) {
  TextProblem problem = row_three();
  problem.runs(30)
      .horizon("44")
      .shrinks("shrinks", "norm(e)", "0.5")
      .law(LawKind::constant, {"T1"});
  problem.law(LawKind::constant, {"T2"});
  const Report report = run(problem);
  EXPECT_EQ(report.verdict, CampaignVerdict::violated);
  EXPECT_EQ(report.violations, 15U);
  EXPECT_EQ(report.worst_run % 2, 1U);
  const Replay again = replay(problem.instance(), problem.gains, report.seed, report.worst_run);
  EXPECT_TRUE(again.claims[0].finding.violated());
  EXPECT_EQ(again.claims[0].finding.value, report.checks[0].worst.value);
  EXPECT_EQ(again.claims[0].finding.score, report.checks[0].worst.score);
}

/// V = x^2/2 falls by x^4 along x' = -x^3, which is the cost.
TEST(Campaign, FlowsThatAreNotAffineAreIntegrated) {
  TextProblem problem;
  problem.state("x", "scalar").flow({{"x", "-x^3"}}).timer("0.5", "1", "0", "1");
  problem.jump({{"x", "0.9*x"}}).runs(40).horizon("10");
  problem.nonincreasing("falls", "x^2").cost("cost", "x^2/2", "x^4", "0.09*x^2");
  problem.shrinks("shrinks", "abs(x)", "0.5");
  const Report report = run(problem);
  EXPECT_EQ(report.verdict, CampaignVerdict::held);
  TextProblem dear = problem;
  dear.cost("dear", "x^2/2", "1.5*x^4", "0.2*x^2");
  const Report violated = run(dear);
  EXPECT_EQ(violated.verdict, CampaignVerdict::violated);
  EXPECT_EQ(violated.checks[0].violations, 0U);
  EXPECT_EQ(violated.checks[3].violations, 40U);
  const Replay again = replay(dear.instance(), dear.gains, violated.seed, violated.worst_run);
  EXPECT_TRUE(again.claims[3].finding.violated());
  EXPECT_EQ(again.claims[3].finding.value, violated.checks[3].worst.value);
}

/// A pendulum without friction keeps its energy: neither is certain of it.
TEST(Campaign, WhatTheIntegrationDoesNotShowIsUndecided) {
  TextProblem problem;
  problem.state("x", "2").flow({{"x", "[x(2); -sin(x(1))]"}}).timer("1", "1", "1", "1");
  problem.runs(4).horizon("5").nonincreasing("energy", "x(2)^2/2 - cos(x(1)) + 1");
  const Report report = run(problem);
  EXPECT_EQ(report.verdict, CampaignVerdict::undecided);
  EXPECT_EQ(report.undecided, 4U);
  ASSERT_TRUE(report.first_undecided);
  EXPECT_EQ(report.first_undecided->run, 0U);
  EXPECT_EQ(report.first_undecided->termination, claims::Termination::horizon);
  EXPECT_TRUE(report.first_undecided->finding.undecided());
  EXPECT_EQ(report.repeated, 4U);
}

struct Integrated {
  const char* flow_x;
  const char* flow_y;
  const char* jump_x;
  const char* claim;
  const char* horizon;
  CampaignVerdict verdict;
};

/// Pulses between long steps, rounding that a map blows up, states that begin at 0 with terms that
/// cancel, flows of which a part is over in 1e-11 of a step.
TEST(Campaign, IntegratedFlowsAreNoCauseOfWrongVerdicts) {
  using enum CampaignVerdict;
  const Integrated cases[] = {
      {"0", "where(tau < 0.7, where(tau > 0.3, 10, 0), 0) - 0.1*y", "x", "y", "1", violated},
      {"1", "(100*exp(-((x - 0.51)/0.003)^2) - 0.1)*y", "0", "y", "1", violated},
      {"0", "-0.01*y*abs(y)", "mod(2*x, 1)", "where(x > 1e-3, y, 3)", "101", undecided},
      {"0", "-0.01*y*abs(y)", "x + 0.1", "where(x > 0.3, where(x < 0.35, 3*y, y), y)", "5",
       undecided},
      {"1 - x^2", "-0.1*y + 1e-3*(1 - cos(x))", "x", "y", "1", held},
      {"-1e12*sin(x)", "-0.1*y*abs(y) + x - x", "x", "y + 1e-3*x^2", "1", held}};
  for (const Integrated& one : cases) {
    TextProblem problem;
    problem.state("x", "scalar").state("y", "scalar").timer("1", "1", "1", "1").runs(1);
    problem.flow({{"x", one.flow_x}, {"y", one.flow_y}}).jump({{"x", one.jump_x}});
    problem.start("x", StartKind::expression,
                  {one.flow_x == std::string("-1e12*sin(x)")  ? "1"
                   : one.jump_x == std::string("mod(2*x, 1)") ? "0.1"
                                                              : "0"});
    problem.start("y", StartKind::expression, {"1"}).horizon(one.horizon);
    problem.nonincreasing("claim", one.claim);
    const Report report = run(problem);
    EXPECT_EQ(report.verdict, one.verdict) << one.flow_y << " " << one.jump_x;
  }
}

/// 0.1 + 0.1 + 0.1 is more than 0.3 in double.
TEST(Campaign, AJumpAtTheHorizonBelongsToTheRun) {
  for (const char* flow : {"-y", "-y*abs(y)"}) {
    TextProblem problem;
    problem.state("c", "scalar").state("y", "scalar").timer("0.1", "0.1", "0.1", "0.1").runs(1);
    problem.flow({{"y", flow}}).jump({{"c", "c + 1"}, {"y", "where(c > 1.5, 10*y, y/2)"}});
    problem.start("c", StartKind::expression, {"0"}).start("y", StartKind::expression, {"1"});
    problem.horizon("0.3").nonincreasing("claim", "y");
    EXPECT_EQ(run(problem).verdict, CampaignVerdict::violated) << flow;
    const Replay again = replay(problem.instance(), problem.gains, 1, 0);
    EXPECT_EQ(again.table(again.table.rows() - 1, 1), 3) << flow;
  }
}

/// A flow of fast modes: x'*x rises from 0.113535 to 0.114482 within a tenth of the shortest length.
TEST(Campaign, AShortRiseOfALinearFlowIsFound) {
  TextProblem problem;
  problem.data("M", "3 x 3", "[-47, 27.4, -6; 6.7, -15.8, -62.6; -40.2, 39.9, -25.5]");
  problem.state("x", "3").flow({{"x", "M*x"}}).timer("0.4", "0.8", "0.4", "0.8").runs(3);
  problem.start("x", StartKind::expression, {"[0.09; -0.72; -0.39]"});
  problem.horizon("2").nonincreasing("falls", "x'*x");
  const Report report = run(problem);
  EXPECT_EQ(report.verdict, CampaignVerdict::violated);
  EXPECT_EQ(report.violations, 3U);
  EXPECT_NEAR(report.checks[0].worst.value, 0.114482, 1e-6);
  EXPECT_NEAR(report.checks[0].worst.bound, 0.113535, 1e-6);
}

/// What claims do not depend on is left out, and nothing may be left.
TEST(Campaign, NothingMayBeLeftToIntegrate) {
  for (const char* value : {"0", "T1", "x - x", "-k", "exp(-s)", "tau - tau"}) {
    TextProblem problem;
    problem.data("T1", "scalar", "0.5").state("x", "scalar").state("k", "scalar");
    problem.state("s", "scalar").flow({{"x", "-sin(x)"}, {"s", "1"}}).jump({{"k", "k + 1"}});
    problem.timer("0.5", "1", "0", "1").runs(5).horizon("3").nonincreasing("claim", value);
    const Report report = run(problem);
    EXPECT_EQ(report.verdict, CampaignVerdict::held) << value;
    EXPECT_EQ(replay(problem.instance(), problem.gains, 1, 0).claims.size(), 1U);
  }
}

/// An error that decays below the rounding of what it is the difference of is not certain.
TEST(Campaign, IntegratedErrorsThatMoveByThemselvesAreJudged) {
  TextProblem problem;
  problem.state("z", "scalar").state("zh", "scalar").timer("1", "1", "1", "1");
  problem.flow({{"z", "3*z + tau"}, {"zh", "3*zh + tau - (4 + tau)*(zh - z)"}});
  problem.runs(5).horizon("8").nonincreasing("error", "(z - zh)^2");
  const Report report = run(problem);
  EXPECT_EQ(report.verdict, CampaignVerdict::held);
}

TEST(Campaign, IntegratedErrorsOfWhatGrowsAreUndecided) {
  TextProblem problem;
  problem.state("z", "scalar").state("zh", "scalar").timer("1", "1", "1", "1");
  problem.flow({{"z", "3*z + cos(z)"}, {"zh", "3*zh + cos(zh) - (4 + tau)*(zh - z)"}});
  problem.runs(1).horizon("12").nonincreasing("error", "(z - zh)^2");
  const Report report = run(problem);
  EXPECT_EQ(report.verdict, CampaignVerdict::undecided);
  EXPECT_EQ(report.violations, 0U);
}

TEST(Campaign, ReportDoesNotDependOnTheNumberOfThreads) {
  TextProblem problem = row_two();
  problem.runs(150).horizon("6").shrinks("shrinks", "norm(e)", "0.001");
  problem.nonincreasing("V", "e'*" + std::string(kShape) + "*e + q'*q");
  problem.cost("J", "100*e'*e", "e'*e", "0.01*e'*e");
  const Report one = run(problem, {.runs = {}, .seed = 5, .threads = 1});
  const Report two = run(problem, {.runs = {}, .seed = 5, .threads = 2});
  EXPECT_TRUE(same(one, two));
  EXPECT_GT(one.violations, 0U);  // e'Q e is no Lyapunov function between samples
  const Report other = run(problem, {.runs = {}, .seed = 6, .threads = 2});
  EXPECT_FALSE(same(one, other));
}

/// Row II with times in units `factor` times shorter, and all that the campaign leaves to defaults.
TextProblem row_two_in_units(const std::string& factor) {
  const double c = std::stod(factor);
  TextProblem problem;
  problem.data("c", "scalar", factor).data("w", "scalar", "1/c");
  problem.data("A", "n x n", "[0.2, -1.01; 1, 0]/c").data("C", "p x n", "[0.5, -1]");
  problem.data("T1", "scalar", "0.5*c").data("T2", "scalar", "1.1*c");
  problem.gain("L", column({3.68, -24.47}) / c).gain("F", column({0.104, -0.948}));
  problem.gain("H", scalar(-25.93) / c);
  problem.state("z", "n").state("zh", "n").state("th", "p");
  problem.flow({{"z", "A*z"}, {"zh", "A*zh + L*th"}, {"th", "H*th"}});
  problem.jump({{"zh", "zh + F*(C*z - C*zh)"}, {"th", "(I - C*F)*(C*z - C*zh)"}});
  problem.timer("T1", "T2", "0", "T2");
  problem.nonincreasing("V", "(z - zh)'*(z - zh)");
  problem.cost("J", "20*(z - zh)'*(z - zh) + 1", "w*(z - zh)'*(z - zh)", "0");
  return problem;
}

TEST(Campaign, UnitsOfTimeChangeNoSampleAndNoVerdict) {
  constexpr double kFactor = 1024;
  TextProblem seconds = row_two_in_units("1");
  TextProblem others = row_two_in_units("1024");
  const Report a = run(seconds, {.runs = 25, .seed = 3, .threads = 1});
  const Report b = run(others, {.runs = 25, .seed = 3, .threads = 1});
  EXPECT_EQ(a.verdict, b.verdict);
  EXPECT_EQ(a.violations, b.violations);
  EXPECT_EQ(a.worst_run, b.worst_run);
  EXPECT_EQ(kFactor * a.horizon, b.horizon);
  for (std::size_t i = 0; i < a.checks.size(); ++i) {
    EXPECT_EQ(a.checks[i].worst_run, b.checks[i].worst_run);
    EXPECT_EQ(a.checks[i].worst.judgement, b.checks[i].worst.judgement);
    EXPECT_NEAR(a.checks[i].worst.value / b.checks[i].worst.value, 1, 1e-9);
  }
  for (std::uint64_t law = 0; law < 5; ++law) {  // each law of the default
    const Replay one = replay(seconds.instance(), seconds.gains, 3, law);
    const Replay two = replay(others.instance(), others.gains, 3, law);
    ASSERT_EQ(one.table.rows(), two.table.rows()) << law;
    EXPECT_EQ(kFactor * one.table.col(0), two.table.col(0)) << law;
    const Eigen::Index states = 2;  // after t and j
    EXPECT_EQ(one.table.middleCols(states, 5), two.table.middleCols(states, 5)) << law;
  }
}

/// Runs of a campaign that somebody stops when some of them are done.
TEST(Campaign, AStoppedCampaignReportsTheRunsThatWereMade) {
  constexpr std::uint64_t kMany = 100'000'000;
  TextProblem problem = row_two();
  problem.horizon("20").shrinks("shrinks", "norm(e)", "0.01");
  const tests::StopInTest stop;
  std::jthread impatient([](const std::stop_token& ended) {
    while (Doing::now().of == 0 || Doing::now().done == 0)
      if (ended.stop_requested()) return;
    request_stop();
  });
  const Report report = run(problem, {.runs = kMany, .seed = 1, .threads = 1});
  EXPECT_TRUE(report.interrupted());
  EXPECT_EQ(report.verdict, CampaignVerdict::undecided);
  EXPECT_EQ(report.asked, kMany);
  EXPECT_GT(report.runs, 0U);
  EXPECT_LT(report.runs, kMany);
  EXPECT_THROW(run(problem, {.runs = 1000, .seed = 1, .threads = 1}), Stopped);
  stop_requested = false;
  const Report whole = run(problem, {.runs = report.runs, .seed = 1, .threads = 1});
  EXPECT_EQ(report.worst_run, whole.worst_run);
  EXPECT_EQ(report.checks[0].worst.value, whole.checks[0].worst.value);
}

/// x' = x on runs that start at 1, 2 or 3 (run modulo 3): planted so that the worst run is known.
TextProblem growing(StartKind kind = StartKind::list,
                    const std::vector<std::string>& starts = {"1", "2", "3"}) {
  TextProblem problem;
  problem.data("a", "scalar", "1").state("x", "scalar").flow({{"x", "a*x"}});
  problem.timer("1", "1", "1", "1").horizon("2").runs(9);
  problem.start("x", kind, starts);
  return problem;
}

TEST(Campaign, PlantedFalseClaimIsCaughtInTheRightRun) {
  TextProblem problem = growing();
  problem.nonincreasing("planted", "where(x > 2.5*exp(2), x, 1)");  // rises in run 2 only
  const Report report = run(problem);
  EXPECT_EQ(report.verdict, CampaignVerdict::violated);
  EXPECT_EQ(report.violations, 1U);
  EXPECT_EQ(report.worst_run, 2U);
  EXPECT_EQ(report.checks[0].worst_run, 2U);
  EXPECT_DOUBLE_EQ(report.checks[0].worst.t, 2);
  EXPECT_NEAR(report.checks[0].worst.value, 3 * std::exp(2), 1e-12 * 3 * std::exp(2));
  EXPECT_EQ(report.checks[0].worst.bound, 1);
}

/// Nothing is drawn: of 9 runs 6 would say what the first 3 do.
TEST(Campaign, MakesNoRunTwice) {
  TextProblem problem = growing();
  problem.shrinks("bounded", "x + 1", "exp(2)");
  const Report report = run(problem);
  EXPECT_EQ(report.different, 3U);
  EXPECT_EQ(report.asked, 3U);
  EXPECT_EQ(report.runs, 3U);
  EXPECT_FALSE(report.interrupted());
  EXPECT_EQ(report.violation_probability, 1) << "equal runs say nothing of others";
  EXPECT_EQ(run(problem, {.runs = 2, .seed = 1, .threads = 1}).runs, 2U);
  TextProblem box = growing(StartKind::box, {"1", "3"});
  box.shrinks("bounded", "x + 1", "exp(2)");
  const Report drawn = run(box);
  EXPECT_FALSE(drawn.different);
  EXPECT_EQ(drawn.runs, 9U);
  EXPECT_LT(drawn.violation_probability, 1);
}

TEST(Campaign, HeldCampaignNamesTheRunNearestToViolation) {
  TextProblem problem = growing();
  problem.shrinks("bounded", "x + 1", "exp(2)");  // (x0 e^2 + 1)/((x0 + 1) e^2) grows with x0
  const Report report = run(problem);
  EXPECT_EQ(report.verdict, CampaignVerdict::held);
  EXPECT_EQ(report.worst_run, 2U);
  EXPECT_NEAR(report.checks[0].worst.score, (3 * std::exp(2) + 1) / (4 * std::exp(2)) - 1, 1e-12);
}

TEST(Campaign, ClaimWithoutValuesIsNotStated) {
  TextProblem problem = row_two();
  problem.unknown("P1", "symmetric n").runs(10);
  problem.horizon("44").nonincreasing("V", "e'*P1*e").shrinks("shrinks", "norm(e)", "1");
  const Report report = run(problem);
  EXPECT_EQ(report.verdict, CampaignVerdict::held);
  EXPECT_FALSE(report.checks[0].stated);
  EXPECT_EQ(report.checks[0].missing, std::vector<std::string>{"P1"});
  EXPECT_TRUE(report.checks[1].stated);
}

TEST(Campaign, NoClaimToCheckIsAnError) {
  TextProblem problem = row_two();
  EXPECT_THROW(run(problem), InputError);
  problem.unknown("P1", "symmetric n").nonincreasing("V", "e'*P1*e");
  try {
    run(problem);
    FAIL() << "expected an error";
  } catch (const InputError& error) {
    EXPECT_NE(error.message().find("P1"), std::string::npos) << error.what();
  }
}

TEST(Campaign, RunThatDivergesViolates) {
  TextProblem problem = growing();
  problem.horizon("400").runs(3).shrinks("little", "min(x, 1)", "2");
  const Report report = run(problem);
  EXPECT_EQ(report.verdict, CampaignVerdict::violated);
  EXPECT_EQ(report.unfinished, 3U);
  EXPECT_EQ(report.worst_run, 0U);
  EXPECT_EQ(report.unfinished_termination, claims::Termination::broken_off);
  EXPECT_EQ(report.violation_probability, 1);
}

TEST(Campaign, ClaimThatIsNoNumberDoesNotHold) {
  TextProblem problem = growing();
  problem.runs(3).nonincreasing("log", "log(2.5 - x)");
  const Report report = run(problem);
  EXPECT_EQ(report.verdict, CampaignVerdict::undecided);
  EXPECT_TRUE(std::isnan(report.checks[0].worst.value));
  EXPECT_TRUE(std::isinf(report.checks[0].worst.score));
}

TEST(Campaign, RefusesZeroRuns) {
  TextProblem problem = growing();
  problem.shrinks("bounded", "x", "10");
  EXPECT_THROW(run(problem, {.runs = 0, .seed = {}, .threads = 1}), InputError);
}

TEST(Campaign, HowFarAnErrorShrinksNeedsAHorizon) {
  TextProblem problem = row_two();
  problem.runs(5).nonincreasing("zero", "0*norm(e)").shrinks("shrinks", "norm(e)", "0.01");
  const Report report = run(problem);
  ASSERT_EQ(report.checks.size(), 2U);
  EXPECT_FALSE(report.checks[1].stated);
  EXPECT_EQ(report.checks[1].missing, std::vector<std::string>{"campaign.horizon"});
}

TEST(Campaign, ExactEstimateHoldsInSpiteOfRounding) {
  // With zh(0) = z(0) and th(0) = 0 the error is zero but for rounding, while z grows.
  TextProblem problem = row_two();
  problem.start("z", StartKind::box, {"-10", "10"});
  problem.start("zh", StartKind::expression, {"z"});
  problem.start("th", StartKind::expression, {"zeros(1, 1)"});
  problem.runs(15).horizon("60").nonincreasing("V", "e'*e").cost("J", "e'*e", "e'*e", "0");
  problem.shrinks("shrinks", "norm(e)", "0.1");
  const Report report = run(problem);
  EXPECT_EQ(report.verdict, CampaignVerdict::held);
}

}  // namespace
}  // namespace gainsmith::verify
