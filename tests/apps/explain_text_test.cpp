#include "gainsmith/explain_text.h"

#include <gtest/gtest.h>

namespace gainsmith::app {
namespace {

std::string text_of(double feasible, double beyond, bool at_most) {
  design::Explanation explanation;
  explanation.reaches = {
      {"T2", 1, at_most, feasible, beyond, model::CertificateRecord{true, 0, 31, {}, "problem"}}};
  return explanation_text(explanation);
}

/// A wide bracket, undecided values in it, must not round a limit away.
TEST(ExplainText, ALimitKeepsThreeDigitsOnTheFeasibleSide) {
  EXPECT_NE(text_of(0.113738, 0.539874, true).find("T2 at most 0.113 "), std::string::npos);
  EXPECT_NE(text_of(0.113238, 0.05, false).find("T2 at least 0.114 "), std::string::npos);
  EXPECT_NE(text_of(113738, 999999, true).find("T2 at most 113000 "), std::string::npos);
}

TEST(ExplainText, ALimitHasTheDigitsThatItsBracketSettles) {
  EXPECT_NE(text_of(0.76830719, 0.76830742, true).find("T2 at most 0.768307 "), std::string::npos);
}

/// The prices of a minimum of 16.
std::string prices_of(const std::vector<design::Limit>& active) {
  design::Explanation explanation;
  explanation.gains.verdict = model::Verdict::yes;
  explanation.gains.objective = 16;
  explanation.limits.emplace();
  explanation.limits->active = active;
  return explanation_text(explanation);
}

TEST(ExplainText, EachCellOfThePricesIsExplained) {
  design::Changed free, endless, open, nothing{1e-9, -1e-9};
  free.homogeneous = true;
  endless.unbounded = true;
  const std::string text = prices_of({{"a", 32, 4, {}, free},
                                      {"b", 1, 4, {}, endless},
                                      {"c", 1, 4, {}, open},
                                      {"d", 1, 4, {}, nothing}});
  // 1 % of 16 is 0.16 = 32 * 0.005.
  EXPECT_NE(text.find("a                    32      0.005          4           0 or -inf\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("0.16          4                   0\n"), std::string::npos) << text;
  for (const char* words : {"\nprice       ", "\n0 or -inf   ", "\n-inf        ", "\nnot found   "})
    EXPECT_NE(text.find(words), std::string::npos) << words << text;
  EXPECT_EQ(prices_of({{"d", 1, 4, {}, nothing}}).find("inf"), std::string::npos);
}

TEST(ExplainText, ARelaxationIsAlsoSaidInTheUnitsOfTheInequality) {
  design::Explanation explanation;
  explanation.relaxations = {{"cap", 0.25, 0.368, false, false, 0.2, false},
                             {"floor", 2, {}, false, false, {}, false}};
  const std::string text = explanation_text(explanation);
  EXPECT_NE(text.find("0.25           0.092            0.05\n"), std::string::npos) << text;
  EXPECT_NE(text.find("2               -               -\n"), std::string::npos) << text;
}

TEST(ExplainText, AMarginBelowTheOneAskedForSaysWhatDecided) {
  design::Explanation explanation;
  explanation.gains.verdict = model::Verdict::yes;
  explanation.gains.margins = {{"flow", true, 7e-10, 1e-9, 1, "", true}};
  EXPECT_NE(explanation_text(explanation).find("(flow 7e-10 of 1e-09)"), std::string::npos);
  explanation.gains.margins[0].reached = 1e-10;
  EXPECT_EQ(explanation_text(explanation).find("asked for"), std::string::npos) << "a message does";
  explanation.gains.objective_lower_bound = 1;
  explanation.gains.margins[0].reached = 7e-10;
  EXPECT_EQ(explanation_text(explanation).find("asked for"), std::string::npos)
      << "an optimum lies on the boundary";
  explanation.gains.objective_lower_bound.reset();
  explanation.gains.margins[0].reached = 2e-9;
  EXPECT_EQ(explanation_text(explanation).find("asked for"), std::string::npos);
}

}  // namespace
}  // namespace gainsmith::app
