#include "gainsmith/campaign_text.h"

#include <gtest/gtest.h>

#include <limits>

namespace gainsmith::app {
namespace {

std::string summary_with(double rounding) {
  verify::CheckReport check;
  check.name = "cost";
  check.kind = model::ClaimKind::cost;
  check.undecided = 1;
  check.worst.judgement = claims::Judgement::undecided;
  check.worst.value = 87.4;
  check.worst.bound = 2435;
  check.worst.rounding = rounding;
  check.worst.digits = 31;
  verify::Report report;
  report.runs = report.undecided = 1;
  report.checks = {check};
  return campaign_summary(report, "gains.json");
}

TEST(CampaignText, AnUndecidedComparisonSaysWhatIsKnown) {
  EXPECT_NE(
      summary_with(3e3).find("known to 3e+03 in 31 digits: nothing is certain of 87.4 <= 2435"),
      std::string::npos);
}

TEST(CampaignText, AnErrorWithoutBoundIsSaidInWords) {
  const std::string text = summary_with(std::numeric_limits<double>::infinity());
  EXPECT_NE(text.find("in 31 digits the bound on the error is larger than all numbers: nothing is "
                      "certain of 87.4 <= 2435"),
            std::string::npos)
      << text;
  EXPECT_EQ(text.find("inf"), std::string::npos) << text;
}

}  // namespace
}  // namespace gainsmith::app
