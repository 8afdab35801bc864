#include "design/expectations.h"

#include <gtest/gtest.h>

#include "support/yaml_problem.h"

namespace gainsmith::design {
namespace {

std::string problem_with(const std::string& expect) {
  return "problem: p\nmethod:\n  method: m\n  data: {A: n x n}\n  unknowns: {P: symmetric n}\n"
         "  require: {positive: P > I}\n  minimize: trace(P)\n  gains: {K: A*P}\ndata: {A: [[1, "
         "0], [0, 2]]}\nexpect:\n" +
         expect;
}

model::Gains result() {
  model::Gains gains;
  gains.verdict = model::Verdict::yes;
  gains.solver.status = "optimal";
  gains.objective = 2.5;
  gains.unknowns = {{"P", numbers::Matrix::Identity(2, 2)}};
  gains.gains = {{"K", (numbers::Matrix(2, 2) << 1, 0, 0, 2).finished()}};
  gains.bounds = {{"A*P", 10, 10, true}};
  return gains;
}

std::vector<std::string> differences_of(
    const std::string& expect, std::optional<model::CampaignVerdict> campaign = std::nullopt) {
  const tests::YamlProblem yaml(problem_with(expect));
  return differences(yaml.instance, result(), campaign);
}

TEST(ExpectationsTest, WhatIsAsExpectedGivesNoDifference) {
  EXPECT_TRUE(
      differences_of("  verdict: yes\n  status: optimal\n  campaign: held\n  active_bounds: [A*P]\n"
                     "  values:\n    objective: {value: 2.5001, relative: 1e-3}\n"
                     "    K: {value: [[1, 0], [0, 2]], absolute: 0}\n    trace(P) + objective: "
                     "{value: 4.5, absolute: 1e-12}\n",
                     model::CampaignVerdict::held)
          .empty());
}

TEST(ExpectationsTest, EachDifferenceIsSaidWithItsPlace) {
  const auto found = differences_of(
      "  verdict: no\n  campaign: held\n  active_bounds: []\n  values:\n    objective: {value: "
      "2.6, relative: 1e-3}\n");
  ASSERT_EQ(found.size(), 4U);
  EXPECT_NE(found[0].find("verdict: expected no, found yes"), std::string::npos);
  EXPECT_NE(found[1].find("campaign: expected held, found no campaign"), std::string::npos);
  EXPECT_NE(found[2].find("active bounds: expected none, found A*P"), std::string::npos);
  EXPECT_NE(found[3].find("test.yaml:15:5: objective: expected 2.6"), std::string::npos)
      << found[3];
}

TEST(ExpectationsTest, WithoutGainsTheVerdictAloneDiffers) {
  model::Gains none;
  none.verdict = model::Verdict::no;
  const auto found = [&](const std::string& expect) {
    const tests::YamlProblem yaml(problem_with(expect));
    return differences(yaml.instance, none, std::nullopt);
  };
  const std::string rest =
      "  campaign: held\n  values: {K: {value: [[1, 0], [0, 2]], absolute: 1}}\n";
  ASSERT_EQ(found("  verdict: yes\n" + rest).size(), 1U);
  EXPECT_NE(found("  verdict: yes\n" + rest)[0].find("verdict: expected yes, found no"),
            std::string::npos);
  ASSERT_EQ(found(rest).size(), 1U);
  EXPECT_EQ(found(rest)[0],
            "test.yaml: verdict: expected yes (no 'expect' says otherwise), found no");
  EXPECT_EQ(found("  verdict: no\n" + rest).size(), 2U);
}

TEST(ExpectationsTest, AViolatedCampaignIsADifferenceUnlessItIsExpected) {
  const auto found = differences_of("  verdict: yes\n", model::CampaignVerdict::violated);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NE(found[0].find("campaign: expected held (no 'expect' says otherwise), found violated"),
            std::string::npos);
  EXPECT_TRUE(differences_of("  campaign: violated\n", model::CampaignVerdict::violated).empty());
}

TEST(ExpectationsTest, AMatrixIsComparedElementByElement) {
  const auto found =
      differences_of("  values:\n    K: {value: [[1, 0], [0.1, 2]], absolute: 0.05}\n");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NE(found[0].find("found [1, 0; 0, 2]"), std::string::npos) << found[0];
}

}  // namespace
}  // namespace gainsmith::design
