// The ladder with a scripted solver: which rungs are tried, what they ask and what they mean.
#include "design/ladder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "design/scripted.h"
#include "numbers/dense.h"

namespace gainsmith::design {
namespace {

using lmi::Goal;
using model::Verdict;
using numbers::smallest_eigenvalue;

constexpr double kMargin = 1e-7;  // asked for by default

using testing::Answer;
using testing::Case;
using testing::ended;
using testing::infeasible;
using testing::optimal;
using testing::Scripted;
using testing::unbounded;
using testing::undecided;

using Rungs = std::vector<Rung>;

/// x >= what is asked for, the smallest x wanted: its program is in x itself.
std::string floor_of(const std::string& comparison) {
  return "  unknowns: {x: scalar}\n  require: {floor: " + comparison + "}\n  minimize: x\n";
}

const std::string kFloor = floor_of("x > 1");

/// The objective says nothing of the gain K = y.
const std::string kFreeGain =
    "  unknowns: {x: scalar, y: scalar}\n  require: {floor: x > 1}\n  minimize: x\n"
    "  gains: {K: y}\nsynthesis: {gain_bound: 10}\n";

/// No objective, constant data: the program has the margin as its last variable.
std::string window(bool bounded) {
  return std::string("  unknowns: {x: scalar}\n  require: {low: x > 1, high: x < 2}\n") +
         (bounded ? "  gains: {K: x}\nsynthesis: {gain_bound: 10}\n" : "");
}

std::vector<std::string> names(const model::NamedMatrices& matrices) {
  std::vector<std::string> result;
  for (const auto& [name, matrix] : matrices) result.push_back(name);
  return result;
}

TEST(Ladder, APointThatKeepsItsMarginIsTheAnswer) {
  const Case of(kFloor);
  const Scripted run(of, {[](const sdp::Problem& problem) {
                       sdp::Solution solution = optimal({1.5})(problem);
                       solution.dual_objective = 1 + kMargin;  // F_0 . Y with Y = 1
                       solution.iterations = 7;
                       return solution;
                     }});
  EXPECT_EQ(run.tried, Rungs{Rung::own});
  EXPECT_EQ(run.gains.verdict, Verdict::yes);
  EXPECT_EQ(run.gains.solver.status, "optimal");
  EXPECT_EQ(run.gains.solver.cause, "converged");
  EXPECT_EQ(run.gains.solver.iterations, 7);
  EXPECT_EQ(run.message(), "");
  EXPECT_EQ((*run.gains.find("x"))(0, 0), 1.5);
  EXPECT_EQ(run.gains.objective, 1.5);
  EXPECT_NEAR(run.gains.objective_lower_bound.value(), 1, 1e-15);  // of the problem: x > 1
  ASSERT_EQ(run.gains.margins.size(), 1U);
  EXPECT_EQ(run.gains.margins[0].reached, 0.5);
  EXPECT_FALSE(run.gains.certificate);
}

TEST(Ladder, APointThatIsShortIsBackedOff) {
  const Case of(kFloor);
  const Scripted run(of, {optimal({1 + kMargin / 2}), optimal({1 + 2 * kMargin})});
  EXPECT_EQ(run.tried, (Rungs{Rung::own, Rung::backed_off}));
  EXPECT_EQ(run.gains.verdict, Verdict::yes) << run.message();
  EXPECT_EQ((*run.gains.find("x"))(0, 0), 1 + 2 * kMargin);
  EXPECT_EQ(run.climb.point(), &run.at(Rung::backed_off));
  // X = x - F_0 >= 0: at first x >= 1 + margin, then four times what was short besides.
  EXPECT_DOUBLE_EQ(run.asked[0].f[0].at(0).value, 1 + kMargin);
  EXPECT_NEAR(run.asked[1].f[0].at(0).value, 1 + kMargin + 4 * kMargin / 2, 1e-14);
}

TEST(Ladder, WhereBackingOffFailsTheFirstPointCounts) {
  const Case of(kFloor);
  for (const Answer& second : {undecided(), infeasible(), unbounded()}) {
    const Scripted run(of, {optimal({1 + kMargin / 2}), second});
    EXPECT_EQ(run.tried, (Rungs{Rung::own, Rung::backed_off}));
    EXPECT_EQ(run.gains.verdict, Verdict::undecided);
    EXPECT_EQ(run.gains.solver.status, "undecided");
    EXPECT_EQ(run.gains.solver.cause, "converged");
    EXPECT_EQ(run.climb.point(), &run.climb.own());
    EXPECT_TRUE(run.says("recomputed from the written decimals floor: margin 5e-08, asked for "))
        << run.message();
    EXPECT_FALSE(run.gains.certificate);
  }
}

/// Whatever it is that the second point is short of, it is no yes.
TEST(Ladder, ABackedOffPointIsJudgedByItsOwnMargins) {
  const Case of(kFloor);
  const Scripted run(of, {optimal({1 + kMargin / 2}), optimal({0.5})});
  EXPECT_EQ(run.gains.verdict, Verdict::undecided);
  EXPECT_TRUE(run.says("floor: margin -0.5")) << run.message();
  EXPECT_EQ(run.tried, (Rungs{Rung::own, Rung::backed_off}));
}

TEST(Ladder, WhatIsWorseThanATolerancesWorthIsNotBackedOff) {
  const Case of(kFloor);
  for (const double x : {1 - 2e-6, 0.9, -5.0}) {
    const Scripted run(of, {optimal({x})});
    EXPECT_EQ(run.tried, Rungs{Rung::own}) << x;
    EXPECT_EQ(run.gains.verdict, Verdict::undecided);
  }
}

TEST(Ladder, AnInequalityThatMayTouchIsBackedOffFromZero) {
  const Case of(floor_of("x >= 1"));
  const Scripted run(of, {optimal({1 - 1e-9}), optimal({1})});
  EXPECT_EQ(run.tried, (Rungs{Rung::own, Rung::backed_off}));
  EXPECT_EQ(run.gains.verdict, Verdict::yes);
  EXPECT_DOUBLE_EQ(run.asked[0].f[0].at(0).value, 1);
  EXPECT_NEAR(run.asked[1].f[0].at(0).value, 1 + 4e-9, 1e-15);
}

TEST(Ladder, AnInfeasibleProblemWithoutBoundsIsOne) {
  for (const std::string& method : {kFloor, std::string("  unknowns: {x: scalar}\n  require: {a: "
                                                        "x > 0, b: x < 0}\n")}) {
    const Case of(method);
    const Scripted run(of, {infeasible()});
    EXPECT_EQ(run.tried, Rungs{Rung::own});
    EXPECT_EQ(run.gains.verdict, Verdict::no);
    EXPECT_EQ(run.gains.solver.status, "infeasible");
    EXPECT_EQ(run.message(), "");
    EXPECT_TRUE(run.gains.unknowns.empty());
    EXPECT_FALSE(run.gains.objective);
    ASSERT_TRUE(run.gains.certificate);
    EXPECT_TRUE(run.gains.certificate->checked);
    EXPECT_EQ(run.gains.certificate->residual, 1e-14);
    EXPECT_EQ(run.gains.certificate->min_eigenvalue, 0.25);
    EXPECT_EQ(run.gains.certificate->excluded_radius, 1e14);
    ASSERT_EQ(run.gains.certificate->multipliers.size(), of.lmi.blocks.size());
    EXPECT_EQ(run.gains.certificate->multipliers.back().second,
              numbers::Matrix::Constant(1, 1, static_cast<double>(of.lmi.blocks.size())));
  }
}

/// What a certificate excludes is said in the units of the unknowns.
TEST(Ladder, TheExcludedRadiusIsInTheUnitsOfTheProblem) {
  const Case of("  unknowns: {x: scalar}\n  require: {floor: 2*x > 600}\n  minimize: x\n");
  const Scripted run(of, {infeasible()});
  EXPECT_DOUBLE_EQ(run.gains.certificate.value().excluded_radius, 300 * 1e14);
}

TEST(Ladder, BoundsOnGainsMustNotDecide) {
  const Case of(kFreeGain);
  const Scripted without(of, {infeasible(), infeasible()});
  EXPECT_EQ(without.tried, (Rungs{Rung::own, Rung::free}));
  EXPECT_EQ(without.asked[0].blocks.size(), 2U);
  EXPECT_EQ(without.asked[1].blocks.size(), 1U);
  EXPECT_EQ(without.gains.verdict, Verdict::no);
  EXPECT_EQ(without.message(), "");
  EXPECT_EQ(names(without.gains.certificate.value().multipliers),
            std::vector<std::string>{"floor"});
  for (const Answer& free : {optimal({2, 1e9}), undecided(), unbounded()}) {
    const Scripted within(of, {infeasible(), free});
    EXPECT_EQ(within.tried, (Rungs{Rung::own, Rung::free}));
    EXPECT_EQ(within.gains.verdict, Verdict::no);
    EXPECT_EQ(within.message(),
              "no gains within the gain bound 10: the certificate needs it; raise "
              "synthesis.gain_bound");
    EXPECT_EQ(names(within.gains.certificate.value().multipliers),
              (std::vector<std::string>{"floor", "bound on y"}));
    EXPECT_TRUE(within.gains.unknowns.empty());
  }
}

TEST(Ladder, ALargestMarginThatSufficesIsAPoint) {
  const Case of(window(false));
  const Scripted run(of, {optimal({1.5, 0.25})});
  EXPECT_EQ(run.tried, Rungs{Rung::own});
  EXPECT_EQ(run.at(Rung::own).question.goal, Goal::feasibility);
  EXPECT_EQ(run.gains.verdict, Verdict::yes);
  EXPECT_FALSE(run.gains.objective);
  EXPECT_FALSE(run.gains.objective_lower_bound);
}

TEST(Ladder, ALargestMarginThatIsTooSmallNeedsACertificate) {
  const Case of(window(false));
  for (const Answer& first : {optimal({1.5, 1e-9}), optimal({1.5, -3.0}), infeasible()}) {
    const Scripted no(of, {first, infeasible()});
    EXPECT_EQ(no.tried, (Rungs{Rung::own, Rung::margin}));
    EXPECT_EQ(no.at(Rung::margin).question.goal, Goal::certificate);
    // Without limits on x and without the margin as a variable.
    EXPECT_EQ(no.asked[0].blocks.size(), 4U);
    EXPECT_EQ(no.asked[1].blocks.size(), 2U);
    EXPECT_EQ(no.asked[1].m(), 1);
    EXPECT_EQ(no.gains.verdict, Verdict::no);
    EXPECT_EQ(names(no.gains.certificate.value().multipliers),
              (std::vector<std::string>{"low", "high"}));
  }
  for (const Answer& second : {undecided(), optimal({1e7})}) {
    const Scripted small(of, {optimal({1.5, 1e-9}), second});
    EXPECT_EQ(small.gains.verdict, Verdict::undecided);
    EXPECT_EQ(small.gains.solver.status, "undecided");
    EXPECT_EQ(small.message(), "the largest margin is 1e-09, below the one asked for");
    const Scripted far(of, {infeasible(), second});
    EXPECT_EQ(far.gains.verdict, Verdict::undecided);
    EXPECT_EQ(far.message(), "solutions, if any, are far larger than the data suggest");
    EXPECT_FALSE(far.gains.certificate);
  }
}

TEST(Ladder, ACertificateAtTheMarginIsAskedForWithoutBoundsToo) {
  const Case of(window(true));
  const Scripted no(of, {infeasible(), infeasible(), infeasible()});
  EXPECT_EQ(no.tried, (Rungs{Rung::own, Rung::margin, Rung::free}));
  EXPECT_EQ(no.at(Rung::free).question.goal, Goal::certificate);
  EXPECT_EQ(no.asked[2].blocks.size(), 2U);
  EXPECT_EQ(no.gains.verdict, Verdict::no);
  EXPECT_EQ(no.message(), "");
  const Scripted within(of, {optimal({1.5, 1e-9}), infeasible(), undecided()});
  EXPECT_EQ(within.tried, (Rungs{Rung::own, Rung::margin, Rung::free}));
  EXPECT_EQ(within.gains.verdict, Verdict::no);
  EXPECT_TRUE(within.says("within the gain bound 10"));
  EXPECT_EQ(within.gains.certificate.value().multipliers.size(), 3U);
  const Scripted open(of, {infeasible(), undecided()});
  EXPECT_EQ(open.tried, (Rungs{Rung::own, Rung::margin}));
  EXPECT_EQ(open.gains.verdict, Verdict::undecided);
}

TEST(Ladder, AnUnboundedObjectiveIsSaid) {
  const Scripted run(Case(kFreeGain), {unbounded()});
  EXPECT_EQ(run.tried, Rungs{Rung::own});
  EXPECT_EQ(run.gains.verdict, Verdict::undecided);
  EXPECT_EQ(run.gains.solver.status, "undecided");
  EXPECT_TRUE(run.says("the objective is unbounded below"));
}

TEST(Ladder, WithoutAnAnswerTheCauseIsKept) {
  for (const std::string& method : {kFloor, kFreeGain, window(false), window(true)}) {
    const Scripted run(Case(method), {[](const sdp::Problem& problem) {
                         sdp::Solution solution = ended(sdp::Status::undecided, problem);
                         solution.cause = sdp::Cause::time_limit;
                         solution.message = "out of time";
                         return solution;
                       }});
    EXPECT_EQ(run.tried, Rungs{Rung::own});
    EXPECT_EQ(run.gains.verdict, Verdict::undecided);
    EXPECT_EQ(run.gains.solver.status, "undecided");
    EXPECT_EQ(run.gains.solver.cause, "time-limit");
    EXPECT_EQ(run.message(), "out of time");
    EXPECT_TRUE(run.gains.margins.empty() && run.gains.bounds.empty());
  }
}

TEST(Ladder, AFreeGainIsMarkedByATighterBound) {
  const Case of(kFreeGain);
  const Scripted run(of, {optimal({1.5, 5}), optimal({1.5, 0.5})});
  EXPECT_EQ(run.tried, (Rungs{Rung::own, Rung::tighter}));
  EXPECT_EQ(run.at(Rung::tighter).question.bounds.beta, 1);
  EXPECT_EQ(run.gains.verdict, Verdict::yes);
  ASSERT_EQ(run.gains.bounds.size(), 1U);
  EXPECT_EQ(run.gains.bounds[0].what, "y");
  EXPECT_EQ(run.gains.bounds[0].bound, 10);
  EXPECT_DOUBLE_EQ(run.gains.bounds[0].reached, 5);
  EXPECT_TRUE(run.gains.bounds[0].active);
  EXPECT_EQ((*run.gains.find("y"))(0, 0), 5);  // the point is not the tighter one
  // Another objective, no point, or a gain that stays: the objective asks for the gain.
  for (const Answer& second : {optimal({1.6, 0.5}), undecided(), infeasible(), optimal({1.5, 4})}) {
    const Scripted asked(of, {optimal({1.5, 5}), second});
    EXPECT_EQ(asked.tried, (Rungs{Rung::own, Rung::tighter}));
    EXPECT_EQ(asked.gains.verdict, Verdict::yes);
    EXPECT_FALSE(asked.gains.bounds[0].active);
  }
}

TEST(Ladder, NoTighterBoundWhereItTellsNothing) {
  const Case of(kFreeGain);
  const std::vector<std::pair<double, bool>> gains = {{0.09, false}, {9.95, true}, {-9.95, true}};
  for (const auto& [y, active] : gains) {
    const Scripted run(of, {optimal({1.5, y})});
    EXPECT_EQ(run.tried, Rungs{Rung::own}) << y;
    EXPECT_EQ(run.gains.bounds.at(0).active, active);
  }
  const Scripted wrong(of, {optimal({0.5, 5})});  // not kept
  EXPECT_EQ(wrong.tried, Rungs{Rung::own});
  EXPECT_EQ(wrong.gains.verdict, Verdict::undecided);
  const Scripted plain(Case(window(true)), {optimal({1.5, 0.25})});  // no objective
  EXPECT_EQ(plain.tried, Rungs{Rung::own});
}

TEST(Ladder, ABackedOffPointHasItsTighterBound) {
  const Case of(kFreeGain);
  const Scripted run(of, {optimal({1 + kMargin / 2, 5}), optimal({1.5, 5}), optimal({1.5, 0.1})});
  EXPECT_EQ(run.tried, (Rungs{Rung::own, Rung::backed_off, Rung::tighter}));
  EXPECT_EQ(run.gains.verdict, Verdict::yes);
  EXPECT_TRUE(run.gains.bounds.at(0).active);
  EXPECT_EQ(run.gains.objective, 1.5);
}

/// Of solutions that may have any size the relative margin is too large.
TEST(Ladder, AHomogeneousProblemNamesTheRemedy) {
  const std::string cone = "  unknowns: {x: scalar, y: scalar}\n  require: {a: x > 0, b: y > 0}\n";
  const Scripted yes(Case(cone), {optimal({1, 1, 1})});
  EXPECT_EQ(yes.at(Rung::own).question.goal, Goal::homogeneous_feasibility);
  EXPECT_EQ(yes.gains.verdict, Verdict::yes);
  const Case of(cone + "  minimize: x + y\n");
  const Scripted small(of, {optimal({1, 1e8}), undecided()});
  EXPECT_EQ(small.at(Rung::own).question.goal, Goal::normalised_objective);
  EXPECT_EQ(small.tried, (Rungs{Rung::own, Rung::backed_off}));
  EXPECT_EQ(small.gains.verdict, Verdict::undecided);
  EXPECT_TRUE(small.says("a smaller synthesis.margin, or P > I instead of P > 0, may do"));
  const Scripted negative(of, {optimal({-1, 1e8}), undecided()});
  EXPECT_EQ(negative.gains.verdict, Verdict::undecided);
  EXPECT_FALSE(negative.says("a smaller synthesis.margin"));
}

TEST(Ladder, WhatIsOpenBetweenThePointsIsNoYes) {
  const Case of(
      "  unknowns: {x: scalar}\n  require:\n    wave: {forall: \"t in [0, 1]\", that: \"x + "
      "cos(1e7*t) > 0\"}\n  minimize: x\nsynthesis: {forall: exchange}\n");
  const double unit =
      lmi::formulate(of.lmi, of.bounds, of.posed().choices(), Goal::bounded_objective).unit;
  const Scripted run(of, {optimal({1.0001 / unit})});
  EXPECT_EQ(run.gains.verdict, Verdict::undecided);
  EXPECT_TRUE(run.says("the solver converged, but for all values wave: not settled for t in ["))
      << run.message();
}

TEST(Ladder, ACertificateThatWasNotCheckedIsNoNo) {
  for (const std::string& method : {kFloor, kFreeGain, window(false)}) {
    const Scripted run(Case(method), {infeasible(false)});
    EXPECT_EQ(run.gains.verdict, Verdict::undecided);
    EXPECT_EQ(run.gains.solver.status, "undecided");
    EXPECT_FALSE(run.gains.certificate);
  }
  const Scripted free(Case(kFreeGain), {infeasible(), infeasible(false)});
  EXPECT_TRUE(free.says("within the gain bound 10"));
}

/// A solver that calls everything optimal: yes is said exactly where the matrices satisfy the
/// inequalities, looked at here.
TEST(Ladder, TheSolversWordAloneIsNoYes) {
  const Case of(
      "  unknowns: {P: symmetric 2, g: scalar}\n  require:\n    floor: P > I\n    cap: P < 3*I\n"
      "    link: \"[P, g*[1; 1]; *, 4] > 0\"\n  minimize: trace(P) + g\n");
  std::mt19937 generator(3);
  std::normal_distribution<double> normal;
  int kept = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const double size = std::pow(10.0, -(trial % 10));
    const Answer random = [&](const sdp::Problem& problem) {
      sdp::Solution solution = ended(sdp::Status::optimal, problem);
      solution.x = {1 + size * normal(generator), size * normal(generator),
                    1 + size * normal(generator), size * normal(generator)};
      return solution;
    };
    const Scripted run(random, of);
    const numbers::Matrix& P = *run.gains.find("P");
    const double g = (*run.gains.find("g"))(0, 0);
    numbers::Matrix link(3, 3);
    link << P, numbers::Matrix::Constant(2, 1, g), numbers::Matrix::Constant(1, 2, g), 4;
    const numbers::Matrix I = numbers::Matrix::Identity(2, 2);
    const double least = std::min(
        {smallest_eigenvalue(P - I), smallest_eigenvalue(3 * I - P), smallest_eigenvalue(link)});
    // The margins asked for are kMargin times scales between 1 and 4.
    if (run.gains.verdict == Verdict::yes) EXPECT_GT(least, 0.98 * kMargin) << trial;
    if (least > 4.1 * kMargin) EXPECT_EQ(run.gains.verdict, Verdict::yes) << trial;
    kept += run.gains.verdict == Verdict::yes ? 1 : 0;
  }
  EXPECT_GT(kept, 10);
  EXPECT_LT(kept, 290);
}

TEST(Ladder, WhatIsNoNumberIsNoYes) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Case of(kFloor);
  for (const double x : {nan, std::numeric_limits<double>::infinity()}) {
    try {
      Climb climb(of.posed(), of.bounds, optimal({x}));
      climb.to_answer();
      climb.from_point();
      model::Gains gains;
      conclude(climb, gains);
      EXPECT_EQ(gains.verdict, Verdict::undecided) << x;
    } catch (const InputError&) {
      // Refused by the arithmetic: that is no yes either.
    }
  }
}

}  // namespace
}  // namespace gainsmith::design
