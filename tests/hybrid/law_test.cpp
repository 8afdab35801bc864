#include "hybrid/law.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "bind/stated.h"
#include "hybrid/scenario.h"
#include "support/text_problem.h"

namespace gainsmith::hybrid {
namespace {

using model::LawKind;
using tests::TextProblem;

TextProblem plant() {
  TextProblem problem;
  problem.data("T1", "scalar", "0.5").data("T2", "scalar", "1.1").state("x", "scalar");
  problem.timer("T1", "T2", "0", "T2");
  return problem;
}

std::vector<Law> laws(TextProblem& problem) {
  const model::RunTexts texts = bind::run_texts(problem.instance(), problem.gains);
  const System system = make_system(texts.dynamics, texts.stated.values);
  return make_scenario(texts.campaign, system).laws.front();
}

std::string error_of(TextProblem& problem) {
  try {
    laws(problem);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Law, ConstantAndListGiveTheirValues) {
  TextProblem problem = plant();
  problem.law(LawKind::constant, {"T1 + 0.1"}).law(LawKind::list, {"0.5", "0.75", "T2"});
  const auto made = laws(problem);
  RandomStream random(1, 0);
  EXPECT_EQ(made[0].reset_value(7, 3, random), 0.6);
  for (std::size_t jump = 0; jump < 7; ++jump)
    EXPECT_EQ(made[1].reset_value(jump, 3, random), (std::array{0.5, 0.75, 1.1})[jump % 3]);
  EXPECT_EQ(random.draws(), 0U);
}

TEST(Law, SinusoidIsThatOfThePapersFigureInUnitsOfTheTimer) {
  TextProblem problem = plant();
  problem.law(LawKind::sinusoid);
  RandomStream random(1, 0);
  for (const double t : {0.0, 1.0, 4.7, 100.0})
    EXPECT_NEAR(laws(problem)[0].reset_value(0, t, random), 0.3 * std::sin(t / 1.1) + 0.8, 1e-15);
}

TEST(Law, RandomLawsStayInTheRangeAndCoverIt) {
  TextProblem problem = plant();
  problem.law(LawKind::uniform).law(LawKind::extremes);
  const auto made = laws(problem);
  RandomStream random(3, 4);
  double sum = 0;
  int highs = 0;
  for (int i = 0; i < 4000; ++i) {
    const double uniform = made[0].reset_value(0, 0, random);
    EXPECT_GE(uniform, 0.5);
    EXPECT_LT(uniform, 1.1);
    sum += uniform;
    const double extreme = made[1].reset_value(0, 0, random);
    EXPECT_TRUE(extreme == 0.5 || extreme == 1.1);
    highs += extreme == 1.1 ? 1 : 0;
  }
  EXPECT_EQ(random.draws(), 8000U);
  EXPECT_NEAR(sum / 4000, 0.8, 0.02);  // 7 standard deviations
  EXPECT_NEAR(highs, 2000, 220);
}

TEST(Law, WithoutAnyThereAreFive) {
  TextProblem problem = plant();
  const auto made = laws(problem);
  ASSERT_EQ(made.size(), 5U);
  EXPECT_EQ(made[0].kind, LawKind::uniform);
  EXPECT_EQ(made[1].kind, LawKind::extremes);
  EXPECT_EQ(made[2].kind, LawKind::sinusoid);
  EXPECT_EQ(made[3].values, std::vector{0.5});
  EXPECT_EQ(made[4].values, std::vector{1.1});
}

TEST(Law, WhatIsOutsideByRoundingAloneIsInside) {
  TextProblem inside = plant();  // lengths in [0.5, 1.1]
  inside.law(LawKind::list, {"0.5*(1 - 1e-13)", "1.1*(1 + 1e-13)"});
  EXPECT_EQ(laws(inside)[0].values, (std::vector{0.5, 1.1}));
  TextProblem outside = plant();
  outside.law(LawKind::constant, {"1.1*(1 + 1e-10)"});
  EXPECT_NE(error_of(outside).find("is outside"), std::string::npos);
}

/// The plant with a gain of 0: what uses it is known only with the gain file.
TextProblem plant_with_gain() {
  TextProblem problem = plant();
  problem.gain("g", tests::scalar(0));
  return problem;
}

TEST(Law, ValuesOutsideTheTimersRangeAreRefusedAtTheirPlace) {
  for (const char* value : {"0.4", "0.4 + g"}) {
    TextProblem low = plant_with_gain();
    low.law(LawKind::constant, {value});
    EXPECT_NE(error_of(low).find("test.yaml:1:1: the sampling interval 0.4 is outside"),
              std::string::npos)
        << error_of(low);
  }
  for (const char* value : {"1.2", "1.2 - g"}) {
    TextProblem high = plant_with_gain();
    high.law(LawKind::list, {"0.5", value});
    EXPECT_NE(error_of(high).find("1.2"), std::string::npos);
  }
  TextProblem empty = plant();
  empty.law(LawKind::list);
  EXPECT_NE(error_of(empty).find("at least one interval"), std::string::npos);
}

TEST(Scenario, FirstValueAndHorizonAreChecked) {
  TextProblem first = plant();
  first.first("1.2");
  EXPECT_NE(error_of(first).find("first timer value 1.2 is outside"), std::string::npos);
  TextProblem horizon = plant();
  horizon.horizon("0");
  EXPECT_NE(error_of(horizon).find("horizon must be positive, not 0"), std::string::npos);
  TextProblem zero = plant();
  zero.first("0").horizon("1e-3");
  EXPECT_EQ(error_of(zero), "");
}

TEST(Scenario, WhatTheGainFileDecidesIsCheckedWithIt) {
  TextProblem first = plant_with_gain();
  first.first("1.2 + g");
  EXPECT_NE(error_of(first).find("test.yaml:1:1: the first value 1.2"), std::string::npos)
      << error_of(first);
  TextProblem horizon = plant_with_gain();
  horizon.horizon("g");
  EXPECT_NE(error_of(horizon).find("test.yaml:1:1: the horizon is 0"), std::string::npos)
      << error_of(horizon);
  horizon.gains.gains.clear();
  EXPECT_NE(error_of(horizon).find("test.yaml:1:1: there is no value for g"), std::string::npos)
      << error_of(horizon);
  TextProblem box = plant_with_gain();
  box.start("x", model::StartKind::box, {"1", "g"});
  EXPECT_NE(error_of(box).find("test.yaml:11:5: the box of x is empty"), std::string::npos)
      << error_of(box);
}

TEST(Scenario, StartsAreChecked) {
  using Start = model::StartKind;
  TextProblem unknown = plant();
  unknown.start("y", Start::expression, {"1"});
  EXPECT_NE(error_of(unknown).find("no state 'y'"), std::string::npos);
  TextProblem later = plant();
  later.state("w", "scalar").start("x", Start::expression, {"w"});
  EXPECT_NE(error_of(later).find("has no value yet"), std::string::npos);
  TextProblem empty = plant();
  empty.start("x", Start::box, {"1", "-1"});
  EXPECT_NE(error_of(empty).find("low end above its high end"), std::string::npos);
}

}  // namespace
}  // namespace gainsmith::hybrid
