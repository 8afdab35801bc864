// Attempts with a scripted solver: which are made, what they ask and what they mean.
#include "design/attempts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "design/scripted.h"
#include "numbers/dense/dense.h"

namespace gainsmith::design {
namespace {

using lmi::Goal;
using model::Verdict;
using numbers::smallest_eigenvalue;

constexpr double kShift = 1e-9;  // asked for by default

using testing::Answer;
using testing::Case;
using testing::ended;
using testing::infeasible;
using testing::inside;
using testing::minimum;
using testing::refuting;
using testing::Scripted;
using testing::unbounded;
using testing::undecided;

using AttemptKinds = std::vector<AttemptKind>;

/// The smallest x above 1.
const std::string kFloor = "  unknowns: {x: scalar}\n  require: {floor: x > 1}\n  minimize: x\n";

/// The objective says nothing of the gain K = y.
const std::string kFreeGain =
    "  unknowns: {x: scalar, y: scalar}\n  require: {floor: x > 1}\n  minimize: x\n"
    "  gains: {K: y}\nsynthesis: {gain_bound: 10}\n";

/// low < x < high, without an objective; with bounds the gain K = x is at most 10.
std::string window(const std::string& low, const std::string& high, bool bounded = false) {
  return "  unknowns: {x: scalar}\n  require: {low: x > " + low + ", high: x < " + high + "}\n" +
         (bounded ? "  gains: {K: x}\nsynthesis: {gain_bound: 10}\n" : "");
}

std::vector<std::string> names(const model::NamedMatrices& matrices) {
  std::vector<std::string> result;
  for (const auto& [name, matrix] : matrices) result.push_back(name);
  return result;
}

TEST(Attempts, AMinimumThatHoldsIsTheAnswer) {
  const Case of(kFloor);
  const double least = 1 + 0x1p-23;
  const Scripted run(of, {[&](const sdp::Problem& problem) {
                       sdp::Solution solution = minimum(of, {least})(problem);
                       solution.dual_objective = 1 + kShift;  // F_0 . Y with Y = 1
                       solution.iterations = 7;
                       return solution;
                     }});
  EXPECT_EQ(run.tried, AttemptKinds{AttemptKind::minimum});
  EXPECT_EQ(run.gains.verdict, Verdict::yes);
  EXPECT_EQ(run.gains.solver.status, "optimal");
  EXPECT_EQ(run.gains.solver.cause, "converged");
  EXPECT_EQ(run.gains.solver.iterations, 7);
  EXPECT_EQ(run.message(), "");
  EXPECT_EQ(run.unknown("x"), least);
  EXPECT_EQ(run.gains.objective, least);
  // Of the problem, x > 1, with the rounding of its sums.
  EXPECT_NEAR(run.gains.objective_lower_bound.value(), 1, 1e-12);
  EXPECT_LE(run.gains.objective_lower_bound.value(), 1);
  ASSERT_EQ(run.gains.margins.size(), 1U);
  EXPECT_EQ(run.gains.margins[0].reached, 1);
  EXPECT_EQ(run.gains.margins[0].smallest_eigenvalue, least - 1);
  EXPECT_FALSE(run.gains.certificate);
}

/// The smallest step from the minimum towards a point inside that holds.
TEST(Attempts, AMinimumThatDoesNotHoldIsBlendedWithAPointInside) {
  const Case of(kFloor);
  for (const double x : {1., 1 - 1e-10, 1 - 1e-4}) {
    const Scripted run(of, {minimum(of, {x}), inside(of, {3})});
    EXPECT_EQ(run.tried,
              (AttemptKinds{AttemptKind::minimum, AttemptKind::inside, AttemptKind::blended}))
        << x;
    EXPECT_EQ(run.gains.verdict, Verdict::yes) << run.message();
    EXPECT_EQ(run.attempts.point(), &run.at(AttemptKind::blended));
    EXPECT_GT(run.unknown("x"), 1);
    EXPECT_LT(run.unknown("x") - x, std::max(4e-12, 20 * (1 - x)));
    EXPECT_EQ(run.gains.objective, run.unknown("x"));
    EXPECT_TRUE(run.gains.objective_lower_bound);
  }
}

/// What is no minimum has no lower bound, and nothing is blended with it.
TEST(Attempts, WithoutAMinimumAPointInsideIsTheAnswer) {
  const Case of(kFloor);
  const auto far = [](const Answer& first) {
    return [first](const sdp::Problem& problem) {
      sdp::Solution solution = first(problem);
      solution.x = {0.9};
      solution.dual_objective = 100;
      return solution;
    };
  };
  const auto expect_inside = [](const Scripted& run, const AttemptKinds& tried,
                                const char* message) {
    EXPECT_EQ(run.tried, tried);
    EXPECT_EQ(run.gains.verdict, Verdict::yes);
    EXPECT_EQ(run.unknown("x"), 3);
    EXPECT_EQ(run.gains.objective, 3);
    EXPECT_FALSE(run.gains.objective_lower_bound);
    EXPECT_TRUE(run.says(message)) << run.message();
  };
  expect_inside({of, {far(undecided()), inside(of, {3})}},
                {AttemptKind::minimum, AttemptKind::inside}, "not its minimum");
  expect_inside({of, {far(unbounded()), inside(of, {3})}},
                {AttemptKind::minimum, AttemptKind::inside},
                "that of a point inside: the solver finds it unbounded below");
  expect_inside({of, {far(infeasible()), inside(of, {3}), far(undecided())}},
                {AttemptKind::minimum, AttemptKind::inside, AttemptKind::large_minimum},
                "not its minimum");
}

/// A certificate against x below 1e8 does not end the second question.
TEST(Attempts, WhereAPointHoldsTheMinimumIsSoughtAmongLargeOnes) {
  const Case of(kFloor);
  const Scripted run(of, {infeasible(), inside(of, {3}), minimum(of, {1.5})});
  EXPECT_EQ(run.tried,
            (AttemptKinds{AttemptKind::minimum, AttemptKind::inside, AttemptKind::large_minimum}));
  EXPECT_LT(run.at(AttemptKind::large_minimum).question.effort.certificate_tolerance, 1e-15);
  EXPECT_EQ(run.gains.verdict, Verdict::yes);
  EXPECT_EQ(run.unknown("x"), 1.5);
  EXPECT_FALSE(run.says("not its minimum")) << run.message();
}

TEST(Attempts, APointInsideIsTheAnswerWithoutAnObjective) {
  const Case of(window("1", "2"));
  const Scripted run(of, {inside(of, {1.5})});
  EXPECT_EQ(run.tried, AttemptKinds{AttemptKind::inside});
  EXPECT_EQ(run.at(AttemptKind::inside).question.goal, Goal::interior);
  EXPECT_EQ(run.gains.verdict, Verdict::yes);
  EXPECT_EQ(run.unknown("x"), 1.5);
  EXPECT_EQ(run.message(), "");
  EXPECT_FALSE(run.gains.objective);
  EXPECT_FALSE(run.gains.objective_lower_bound);
}

/// Without constants every solution may be scaled.
TEST(Attempts, AnObjectiveWithoutConstantsHasNoMinimum) {
  const Case of(
      "  unknowns: {x: scalar, y: scalar}\n  require: {a: x > 0, b: y > x}\n  minimize: x + y\n");
  const Scripted run(of, {inside(of, {1, 2})});
  EXPECT_EQ(run.tried, AttemptKinds{AttemptKind::inside});
  EXPECT_EQ(run.gains.verdict, Verdict::yes);
  EXPECT_FALSE(run.gains.objective);
  EXPECT_FALSE(run.gains.objective_lower_bound);
  EXPECT_TRUE(run.says("the objective was not used: without constant parts")) << run.message();
}

/// x > 2 and x < 1: their sum is 0 x - 1 > 0.
TEST(Attempts, MultipliersThatExcludeEverythingAreANo) {
  for (const std::string minimize : {"", "  minimize: x\n"}) {
    const Case of(window("2", "1") + minimize);
    std::vector<Answer> script = {refuting(of, {3, 3})};
    if (!minimize.empty()) script.insert(script.begin(), infeasible());
    const Scripted run(of, script);
    EXPECT_EQ(run.tried.back(), AttemptKind::inside);
    EXPECT_EQ(run.gains.verdict, Verdict::no) << run.message();
    EXPECT_EQ(run.gains.solver.status, "infeasible");
    EXPECT_EQ(run.message(), "");
    EXPECT_TRUE(run.gains.unknowns.empty());
    EXPECT_FALSE(run.gains.objective);
    ASSERT_TRUE(run.gains.certificate);
    EXPECT_TRUE(run.gains.certificate->exact);
    EXPECT_TRUE(run.gains.certificate->is_about_problem());
    EXPECT_LT(run.gains.certificate->backward_error, 1e-28);
    EXPECT_EQ(run.gains.certificate->digits, 100);
    EXPECT_EQ(names(run.gains.certificate->multipliers), (std::vector<std::string>{"low", "high"}));
    for (const auto& [name, Y] : run.gains.certificate->multipliers)
      EXPECT_EQ(Y, numbers::Matrix::Constant(1, 1, 3)) << name;
  }
}

/// Multipliers that do not add up and are near none that do.
TEST(Attempts, WhatIsNoCertificateIsNoNo) {
  // Roots have no fractions: nothing but the multipliers can decide.
  const Case of(window("sqrt(4)", "sqrt(1)"));
  const Case feasible(window("sqrt(1)", "sqrt(4)"));
  // No step leads from the multiplier 0 to another.
  const Scripted stuck(refuting(of, {0, 3}), of);
  EXPECT_EQ(stuck.tried, (AttemptKinds{AttemptKind::inside, AttemptKind::in_31_digits}));
  EXPECT_EQ(stuck.gains.verdict, Verdict::undecided);
  EXPECT_FALSE(stuck.gains.certificate);
  EXPECT_TRUE(stuck.says("the largest margin found is 0")) << stuck.message();
  // From others Newton's method finds the certificate.
  for (const double y : {0.9, 1.1}) {
    const Scripted near(refuting(of, {1, y}), of);
    EXPECT_EQ(near.tried, (AttemptKinds{AttemptKind::inside})) << y;
    EXPECT_EQ(near.gains.verdict, Verdict::no) << y;
  }
  for (const double y : {1e-6, 0.99, 1., 2., 1e6}) {
    const Answer any = refuting(feasible, {1, y});
    const Scripted run(any, feasible);
    EXPECT_EQ(run.gains.verdict, Verdict::undecided) << y;
  }
}

/// What stands in the blocks themselves needs no solver, and nothing is solved where only one x is.
TEST(Attempts, PlainStepsOnFacesDecideWhateverTheSolverSays) {
  const Case none(window("2", "1"));
  const Scripted no(refuting(none, {0, 3}), none);
  EXPECT_EQ(no.gains.verdict, Verdict::no);
  ASSERT_TRUE(no.gains.certificate);
  EXPECT_TRUE(no.gains.certificate->exact);
  EXPECT_TRUE(no.says("low and high exclude each other")) << no.message();
  const Case one(
      "  unknowns: {x: scalar, y: scalar}\n  require: {least: x + 2*y >= 0.3, most: x + 2*y <= "
      "0.3, same: y >= 0.1, too: y <= 0.1}\n");
  const Scripted yes(undecided(), one);
  EXPECT_EQ(yes.gains.verdict, Verdict::yes) << yes.message();
  EXPECT_EQ(yes.unknown("x"), 0.1);
  EXPECT_EQ(yes.unknown("y"), 0.1);
}

TEST(Attempts, MoreDigitsAreAskedForWithoutBoundsWhereNothingIsDecided) {
  const Case of(window("sqrt(1)", "sqrt(4)", true));
  const Scripted run(of, {undecided(), undecided(), undecided(), inside(of, {1.5})});
  EXPECT_EQ(run.tried, (AttemptKinds{AttemptKind::inside, AttemptKind::free_inside,
                                     AttemptKind::in_31_digits}));
  EXPECT_EQ(run.asked[0].blocks.size(), 4U);
  EXPECT_EQ(run.asked[1].blocks.size(), 2U) << "the least violation";
  EXPECT_EQ(run.efforts[1].precision, "double");
  EXPECT_EQ(run.asked[2].blocks.size(), 5U);
  EXPECT_EQ(run.efforts[3].precision, "quad");
  EXPECT_EQ(run.gains.verdict, Verdict::yes) << run.message();
}

/// Corners of a box that no value of the variable reaches: nothing is gained by more digits.
TEST(Attempts, BlocksThatStandForNoPointAreNotSolvedInMoreDigits) {
  const Case of(
      "  unknowns: {x: scalar}\n  require:\n    a: {forall: \"t in [0, 1]\", that: \"x*(3 - "
      "exp(t)) "
      "> t + exp(-t)\"}\n    b: x < 0\nsynthesis: {forall: hull}\n");
  ASSERT_FALSE(of.lmi.represents_points());
  const Scripted run(of, {undecided()});
  EXPECT_EQ(run.tried, AttemptKinds{AttemptKind::inside});
  EXPECT_EQ(run.gains.verdict, Verdict::undecided);
}

/// Gains beyond their bound are no answer, but they are told of.
TEST(Attempts, BoundsOnGainsMustNotDecide) {
  const Case of(
      "  unknowns: {x: scalar}\n  require: {floor: x > 15}\n  minimize: x\n  gains: {K: x}\n"
      "synthesis: {gain_bound: 10}\n");
  const Scripted beyond(of, {infeasible(), undecided(), minimum(of, {16})});
  EXPECT_EQ(beyond.tried,
            (AttemptKinds{AttemptKind::minimum, AttemptKind::inside, AttemptKind::free_minimum}));
  EXPECT_EQ(beyond.asked[0].blocks.size(), 2U);
  EXPECT_EQ(beyond.asked[2].blocks.size(), 1U);
  EXPECT_EQ(beyond.gains.verdict, Verdict::undecided);
  EXPECT_EQ(beyond.gains.bound_only, 16);
  EXPECT_TRUE(
      beyond.says("no gains were found under the gain bound 10, whose condition is "
                  "sufficient only; without it there are gains: raise"))
      << beyond.message();
  EXPECT_EQ(beyond.message().find("16"), std::string::npos) << "it is no smallest bound";
  EXPECT_FALSE(beyond.gains.objective) << "that of the inequalities without the bound";
  EXPECT_FALSE(beyond.gains.objective_lower_bound);
  EXPECT_TRUE(beyond.gains.margins.empty());
  EXPECT_EQ(beyond.gains.solver.status, "undecided");
  EXPECT_FALSE(beyond.gains.certificate);
  // Found without the bound, but within it.
  const Case low(kFreeGain);
  const Scripted within(low, {undecided(), undecided(), minimum(low, {2, 3})});
  EXPECT_EQ(within.gains.verdict, Verdict::yes) << within.message();
  EXPECT_FALSE(within.gains.bound_only);
}

/// Only a certificate without the bounds is one of the problem.
TEST(Attempts, ANoNeedsNoBounds) {
  const Case of(window("2", "1", true));
  const Scripted run(of, {refuting(of, {1, 1})});
  EXPECT_EQ(run.tried, AttemptKinds{AttemptKind::free_inside});
  EXPECT_TRUE(run.at(AttemptKind::free_inside).question.bounds.list.empty());
  EXPECT_EQ(run.gains.verdict, Verdict::no);
  EXPECT_EQ(names(run.gains.certificate.value().multipliers),
            (std::vector<std::string>{"low", "high"}));
}

TEST(Attempts, WithoutAnAnswerTheCauseIsKept) {
  const Answer late = [](const sdp::Problem& problem) {
    sdp::Solution solution = ended(sdp::Status::undecided, problem);
    solution.cause = sdp::Cause::iteration_limit;
    return solution;
  };
  for (const std::string& method : {kFloor, kFreeGain, window("1", "2"), window("1", "2", true)}) {
    const Case of(method);
    const Scripted run(late, of);
    EXPECT_EQ(run.tried.back(), AttemptKind::in_31_digits);
    EXPECT_EQ(run.gains.verdict, Verdict::undecided);
    EXPECT_EQ(run.gains.solver.status, "undecided");
    EXPECT_EQ(run.gains.solver.cause, "iteration-limit");
    EXPECT_TRUE(run.gains.margins.empty() && run.gains.bounds.empty());
  }
}

TEST(Attempts, AFreeGainIsMarkedByATighterBound) {
  const Case of(kFreeGain);
  const Scripted run(of, {minimum(of, {1.5, 5}), minimum(of, {1.5, 0.5})});
  EXPECT_EQ(run.tried, (AttemptKinds{AttemptKind::minimum, AttemptKind::tighter}));
  EXPECT_EQ(run.at(AttemptKind::tighter).question.bounds.beta, 1);
  EXPECT_EQ(run.gains.verdict, Verdict::yes);
  ASSERT_EQ(run.gains.bounds.size(), 1U);
  EXPECT_EQ(run.gains.bounds[0].what, "y");
  EXPECT_EQ(run.gains.bounds[0].bound, 10);
  EXPECT_NEAR(run.gains.bounds[0].reached, 5, 1e-11);
  EXPECT_TRUE(run.gains.bounds[0].active);
  EXPECT_EQ(run.unknown("y"), 5);  // the point is not the tighter one
  // Another objective, no point, or a gain that stays: the objective asks for the gain.
  for (const Answer& second :
       {minimum(of, {1.6, 0.5}), undecided(), infeasible(), minimum(of, {1.5, 4})}) {
    const Scripted asked(of, {minimum(of, {1.5, 5}), second});
    EXPECT_EQ(asked.tried, (AttemptKinds{AttemptKind::minimum, AttemptKind::tighter}));
    EXPECT_EQ(asked.gains.verdict, Verdict::yes);
    EXPECT_FALSE(asked.gains.bounds[0].active);
  }
}

TEST(Attempts, NoTighterBoundWhereItTellsNothing) {
  const Case of(kFreeGain);
  const std::vector<std::pair<double, bool>> gains = {{0.09, false}, {9.95, true}, {-9.95, true}};
  for (const auto& [y, active] : gains) {
    const Scripted run(of, {minimum(of, {1.5, y})});
    EXPECT_EQ(run.tried, AttemptKinds{AttemptKind::minimum}) << y;
    EXPECT_EQ(run.gains.bounds.at(0).active, active);
  }
  const Case plain(window("1", "2", true));  // no objective
  EXPECT_EQ(Scripted(plain, {inside(plain, {1.5})}).tried, AttemptKinds{AttemptKind::free_inside});
}

TEST(Attempts, ABlendedPointHasItsTighterBound) {
  const Case of(kFreeGain);
  const Scripted run(of, {minimum(of, {1, 5}), inside(of, {2, 5}), minimum(of, {1, 0.1})});
  EXPECT_EQ(run.tried, (AttemptKinds{AttemptKind::minimum, AttemptKind::inside,
                                     AttemptKind::blended, AttemptKind::tighter}));
  EXPECT_EQ(run.gains.verdict, Verdict::yes);
  EXPECT_NEAR(run.gains.objective.value(), 1, 1e-11);
}

/// A yes does not depend on the margin asked for; what is missing is said where nothing is
/// minimised.
TEST(Attempts, LessThanTheMarginAskedForIsAYesThatSaysSo) {
  const std::string method = "  unknowns: {x: scalar}\n  require:\n    a: \"[x, 1; 1, 1] > 0\"\n";
  const std::string margin = "synthesis: {margin: 0.1}\n";
  // Without the ceiling simpler decimals are found that keep the margin.
  const Case plain(method + "    ceiling: x < 1.000002\n" + margin);
  const Answer near = inside(plain, {1 + 1e-6});
  const Scripted run(plain, {near, near});
  EXPECT_EQ(run.gains.verdict, Verdict::yes);
  EXPECT_TRUE(run.says("with less margin than asked for (a ")) << run.message();
  const Case minimal(method + "  minimize: x\n" + margin);
  const Scripted least(minimal, {minimum(minimal, {1 + 1e-6})});
  EXPECT_EQ(least.gains.verdict, Verdict::yes);
  EXPECT_FALSE(least.says("less margin")) << "an optimum lies on the boundary";
}

TEST(Attempts, WhatIsOpenBetweenThePointsIsNoYes) {
  const Case of(
      "  unknowns: {x: scalar}\n  require:\n    wave: {forall: \"t in [0, 1]\", that: \"sqrt(1)*x "
      "+ "
      "cos(3e4*t) > 0\"}\n  minimize: x\nsynthesis: {forall: exchange}\n");
  const Answer point = [&](const sdp::Problem& problem) {
    return problem.c.back() == -1 ? inside(of, {1.0001})(problem) : minimum(of, {1.0001})(problem);
  };
  const Scripted run(point, of);
  EXPECT_EQ(run.gains.verdict, Verdict::undecided);
  EXPECT_TRUE(run.says("for all values wave: not settled for t in [")) << run.message();
}

/// A solver that calls everything optimal: yes is said exactly where the matrices satisfy the
/// inequalities, looked at here.
TEST(Attempts, TheSolversWordAloneIsNoYes) {
  const Case of(
      "  unknowns: {P: symmetric 2, g: scalar}\n  require:\n    floor: P > sqrt(1)*I\n    cap: P < "
      "sqrt(9)*I\n"
      "    link: \"[P, g*[1; 1]; *, sqrt(16)] > 0\"\n  minimize: trace(P) + g\n");
  std::mt19937 generator(3);
  std::normal_distribution<double> normal;
  int kept = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const double size = std::pow(10.0, -(trial % 10));
    const std::vector<double> x = {1 + size * normal(generator), size * normal(generator),
                                   1 + size * normal(generator), size * normal(generator)};
    const Answer random = [&](const sdp::Problem& problem) {
      return problem.c.back() == -1 ? inside(of, x)(problem) : minimum(of, x)(problem);
    };
    const Scripted run(random, of);
    numbers::Matrix P(2, 2), link(3, 3);
    P << x[0], x[1], x[1], x[2];
    link << P, numbers::Matrix::Constant(2, 1, x[3]), numbers::Matrix::Constant(1, 2, x[3]), 4;
    const numbers::Matrix I = numbers::Matrix::Identity(2, 2);
    const double least = std::min(
        {smallest_eigenvalue(P - I), smallest_eigenvalue(3 * I - P), smallest_eigenvalue(link)});
    if (std::abs(least) < 1e-14) continue;
    EXPECT_EQ(run.gains.verdict, least > 0 ? Verdict::yes : Verdict::undecided) << trial;
    kept += run.gains.verdict == Verdict::yes ? 1 : 0;
  }
  EXPECT_GT(kept, 10);
  EXPECT_LT(kept, 290);
}

TEST(Attempts, WhatIsNoNumberIsNoYes) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const std::string& method : {kFloor, window("1", "2")})
    for (const double x : {nan, std::numeric_limits<double>::infinity()}) {
      const Case of(method);
      Attempts attempts(of.posed(), of.bounds, [&](const sdp::Problem& problem, const Effort&) {
        return problem.c.back() == -1 ? inside(of, {x}, x)(problem) : minimum(of, {x})(problem);
      });
      attempts.to_point();
      attempts.to_end();
      model::Gains gains;
      conclude(attempts, {}, gains);
      EXPECT_EQ(gains.verdict, Verdict::undecided) << x;
    }
}

}  // namespace
}  // namespace gainsmith::design
