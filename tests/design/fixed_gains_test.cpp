// Inequalities at gains that are given: proved, refuted, or honestly open.
#include "design/fixed_gains.h"

#include <gtest/gtest.h>

#include <string>

#include "design/synthesize.h"
#include "support/input_error.h"
#include "support/yaml_problem.h"

namespace gainsmith::design {
namespace {

/// e' = (A - L C) e with A = [0, 1; -1, 0], C = [1, 0]: every L with L1 > 0, L2 > -1 is stable.
const std::string kObserver =
    "problem: p\nmethod:\n  method: m\n  data: {A: n x n, C: p x n}\n  unknowns: {P: symmetric n, "
    "Y: n x p}\n"
    "  require: {positive: P > I, decay: He(P*A - Y*C) < 0}\n  gains: {L: inv(P)*Y}\n"
    "data: {A: [[0, 1], [-1, 0]], C: [[1, 0]]}\n";

struct Solved {
  tests::YamlProblem yaml;
  model::Gains gains;

  explicit Solved(const std::string& text) : yaml(text), gains(synthesize(yaml.instance, {})) {}
  GainCheck check() const { return check_gains(yaml.instance, gains, {}); }
  void set(const std::string& name, const numbers::Matrix& value) {
    for (auto& [known, matrix] : gains.gains)
      if (known == name) matrix = value;
  }
};

TEST(FixedGains, SynthesizedGainsHoldWithTheirOwnUnknowns) {
  const Solved solved(kObserver);
  const GainCheck check = solved.check();
  EXPECT_EQ(check.verdict, model::Verdict::yes);
  EXPECT_TRUE(check.own_unknowns);
  EXPECT_TRUE(check.edited.empty());
  EXPECT_EQ(check.margins.size(), 2U);
}

TEST(FixedGains, AnUnknownThatIsNoLongerSymmetricIsNotTaken) {
  Solved solved(kObserver);
  for (auto& [name, matrix] : solved.gains.unknowns)
    if (name == "P") matrix(0, 1) += 1;
  EXPECT_FALSE(solved.check().own_unknowns);
}

TEST(FixedGains, TheUnknownFollowsFromTheGain) {
  const Solved solved(kObserver);
  const FixedGains fixed = fix_gains(solved.yaml.instance, solved.gains);
  EXPECT_EQ(fixed.instance.design->unknowns.size(), 1U);
  EXPECT_EQ(fixed.instance.values.at("value of L"), solved.gains.gains[0].second);
  EXPECT_TRUE(fixed.solvable);
}

TEST(FixedGains, EditedGainsAreShownWithUnknownsSolvedAnew) {
  Solved solved(kObserver);
  solved.set("L", numbers::Matrix{{200}, {-0.9}});
  const GainCheck check = solved.check();
  EXPECT_EQ(check.verdict, model::Verdict::yes);
  EXPECT_FALSE(check.own_unknowns);
  EXPECT_EQ(check.edited, std::vector<std::string>{"L"});
  EXPECT_EQ(check.not_shown, std::vector<std::string>{"decay"});
}

TEST(FixedGains, GainsThatAreUnstableAreRefuted) {
  Solved solved(kObserver);
  for (const double second : {-1.0, -1.5}) {
    solved.set("L", numbers::Matrix{{1}, {second}});
    EXPECT_EQ(solved.check().verdict, model::Verdict::no) << second;
  }
  solved.set("L", numbers::Matrix{{-0.001}, {0}});
  EXPECT_EQ(solved.check().verdict, model::Verdict::no);
}

TEST(FixedGains, DecimalsOfTheFileCount) {
  // x > 0 with the gain K = x - 0.1: at the decimal 0.1 x is 0.2 exactly, and at less it is below.
  Solved solved(
      "problem: p\nmethod:\n  method: m\n  unknowns: {x: scalar}\n"
      "  require: {low: \"x >= 0.2\", high: x < 1}\n  gains: {K: x - 0.1}\n");
  solved.set("K", numbers::Matrix::Constant(1, 1, 0.1));
  EXPECT_EQ(solved.check().verdict, model::Verdict::yes);
  solved.gains.decimals["gains.K"] = {"0.09999999999999999999999999999"};
  EXPECT_EQ(solved.check().verdict, model::Verdict::no);
}

TEST(FixedGains, GainsThatAreDataReplaceThem) {
  Solved solved(
      "problem: p\nmethod:\n  method: m\n  data: {A: n x n, K: n x n}\n  unknowns: {P: symmetric "
      "n}\n"
      "  require: {positive: P > I, decay: He(P*(A + K)) < 0}\n  gains: {K: K}\n"
      "data: {A: [[1]], K: [[-2]]}\n");
  EXPECT_EQ(solved.check().verdict, model::Verdict::yes);
  solved.set("K", numbers::Matrix{{-0.5}});
  const GainCheck check = solved.check();
  EXPECT_EQ(check.verdict, model::Verdict::no);
  EXPECT_EQ(check.edited, std::vector<std::string>{"K"});
}

TEST(FixedGains, WithoutInequalitiesThereIsNothingToShow) {
  Solved solved(
      "problem: p\nmethod:\n  method: m\n  data: {A: n x n}\n  gains: {K: 2*A}\n  plant: {state: "
      "{x: n}, flow: {x: A*x}}\ndata: {A: "
      "[[1]]}\n");
  solved.set("K", numbers::Matrix{{3}});
  const GainCheck check = solved.check();
  EXPECT_EQ(check.verdict, model::Verdict::yes);
  EXPECT_EQ(check.edited, std::vector<std::string>{"K"});
}

/// Two gains, one of which stands in the formula of the other.
TEST(FixedGains, GainsInFormulasOfOthersAreThoseOfTheFile) {
  const std::string text =
      "problem: p\nmethod:\n  method: m\n  data: {C: p x n}\n"
      "  unknowns: {P: symmetric n, R: symmetric p, Y: n x p, X: p x p}\n"
      "  require: {positive: P > I, other: R > I, low: \"He(X) - 2*R < 0\", size: \"He(Y*C) - P < "
      "0\"}\n"
      "  gains: {H: inv(R)*X - C*inv(P)*Y, L: inv(P)*Y}\ndata: {C: [[1, 0]]}\n";
  Solved solved(text);
  ASSERT_EQ(solved.gains.verdict, model::Verdict::yes);
  EXPECT_EQ(solved.check().verdict, model::Verdict::yes);
  const FixedGains fixed = fix_gains(solved.yaml.instance, solved.gains);
  EXPECT_EQ(fixed.instance.design->unknowns.size(), 2U);
  // X = R (H + C L): H + L1 < 1 is what `low` says.
  solved.set("L", numbers::Matrix{{0.25}, {0}});
  solved.set("H", numbers::Matrix{{0.5}});
  EXPECT_EQ(solved.check().verdict, model::Verdict::yes);
  solved.set("H", numbers::Matrix{{0.75}});
  EXPECT_EQ(solved.check().verdict, model::Verdict::no);
}

TEST(FixedGains, WhatCannotBeTurnedAroundIsUndecidedOnceEdited) {
  Solved solved(
      "problem: p\nmethod:\n  method: m\n  data: {A: n x n}\n  unknowns: {P: symmetric n, Y: n x "
      "n}\n"
      "  require: {positive: P > I, decay: He(P*A - Y) < 0}\n  gains: {L: \"inv(P)*Y*[1; 0]\"}\n"
      "data: {A: [[0, 1], [-1, 0]]}\n");
  EXPECT_EQ(solved.check().verdict, model::Verdict::yes);
  solved.set("L", numbers::Matrix{{1}, {1}});
  const GainCheck check = solved.check();
  EXPECT_EQ(check.verdict, model::Verdict::undecided);
  EXPECT_NE(check.message.find("L: inv(P)*Y*[1; 0]"), std::string::npos) << check.message;
}

TEST(FixedGains, PolynomialGainsAreFunctions) {
  Solved solved(
      "problem: p\nmethod:\n  method: m\n  data: {C: p x n}\n"
      "  unknowns: {P: symmetric n, Z: {shape: n x p, of: s, degree: 1}}\n"
      "  require: {positive: P > I, close: {forall: \"s in [0, 1]\", that: \"He(Z(s)*C - s*P) < "
      "P\"},\n"
      "            far: {forall: \"s in [0, 1]\", that: \"He(Z(s)*C - s*P) > -8*P\"}}\n"
      "  gains: {F(s): inv(P)*Z(s)}\ndata: {C: [[1]]}\n");
  ASSERT_EQ(solved.gains.verdict, model::Verdict::yes);
  const GainCheck fresh = solved.check();
  EXPECT_EQ(fresh.verdict, model::Verdict::yes) << fresh.message;
  // 2 (F(s) - s) < 1 for F = f: f < 1/2.
  solved.gains.gain_functions.clear();
  solved.gains.gains = {{"F", numbers::Matrix{{0.4}}}};
  EXPECT_EQ(solved.check().verdict, model::Verdict::yes);
  solved.gains.gains = {{"F", numbers::Matrix{{0.6}}}};
  EXPECT_EQ(solved.check().verdict, model::Verdict::no);
}

}  // namespace
}  // namespace gainsmith::design
