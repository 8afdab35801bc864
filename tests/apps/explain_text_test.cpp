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

}  // namespace
}  // namespace gainsmith::app
