#include "gainsmith/campaign_text.h"

#include <gtest/gtest.h>

#include <limits>

namespace gainsmith::app {
namespace {

std::string summary_with(double rounding, double value = 87.4) {
  verify::CheckReport check;
  check.name = "cost";
  check.kind = model::ClaimKind::cost;
  check.undecided = 1;
  check.worst.judgement = claims::Judgement::undecided;
  check.worst.value = value;
  check.worst.bound = 2435;
  check.worst.rounding = rounding;
  verify::Report report;
  report.runs = report.undecided = 1;
  report.checks = {check};
  return campaign_summary(report, "gains.json");
}

TEST(CampaignText, AnUndecidedComparisonSaysWhatIsKnown) {
  EXPECT_NE(summary_with(3e3).find(
                "known to 3e+03 by two integrations: nothing is certain of 87.4 <= 2435"),
            std::string::npos);
}

TEST(CampaignText, ATieIsCalledSo) {
  const std::string text = summary_with(3e-9, 2435 - 1e-9);
  EXPECT_NE(text.find("equal to its bound as far as two integrations tell, to 3e-09: a tie"),
            std::string::npos)
      << text;
}

TEST(CampaignText, AnErrorWithoutBoundIsSaidInWords) {
  const std::string text = summary_with(std::numeric_limits<double>::infinity());
  EXPECT_NE(text.find("have parted by then"), std::string::npos) << text;
  EXPECT_EQ(text.find("inf"), std::string::npos) << text;
}

/// Run 7 of 20 is the first of two that are undecided.
verify::Report two_undecided() {
  verify::Report report;
  report.verdict = model::CampaignVerdict::undecided;
  report.runs = report.asked = 20;
  report.undecided = 2;
  report.worst_run = 9;
  report.checks.resize(2);
  report.checks[1].name = "small";
  report.first_undecided = {7, claims::Termination::horizon, "", 1, {}};
  claims::Finding& finding = report.first_undecided->finding;
  finding.judgement = claims::Judgement::undecided;
  finding.rounding = 0.5;
  finding.value = 1.25;
  finding.bound = 1.5;
  finding.t = 3;
  return report;
}

TEST(CampaignText, TheFirstUndecidedRunSaysWhy) {
  const std::string text = campaign_summary(two_undecided(), "gains.json");
  for (const char* words :
       {"undecided in 2 of 20 runs, worst run 9",
        "2 of 20 runs undecided; first run 7: small at (t, j) = (3, 0): known to 0.5 by two "
        "integrations: nothing is certain of 1.25 <= 1.5",
        "simulate gains.json --run 7"})
    EXPECT_NE(text.find(words), std::string::npos) << words << "\n" << text;
}

TEST(CampaignText, ARunThatEndsEarlyIsNotSaidToBeTooClose) {
  verify::Report report = two_undecided();
  report.unfinished = 2;
  report.unfinished_run = 7;
  report.first_undecided->termination = claims::Termination::lost;
  report.first_undecided->message = "the order of two events is open";
  const std::string text = campaign_summary(report, "gains.json");
  EXPECT_NE(text.find("it ends at t = 3, before the horizon: the order of two events is open"),
            std::string::npos)
      << text;
  for (const char* words : {"tolerance", "nothing is certain", "reach the horizon; run"})
    EXPECT_EQ(text.find(words), std::string::npos) << words << "\n" << text;
}

TEST(CampaignText, AClaimThatAnEndLeavesOpenIsNoComparison) {
  verify::Report report = two_undecided();
  verify::CheckReport& check = report.checks[1];
  check.undecided = 1;
  check.worst_run = 7;
  check.worst.judgement = claims::Judgement::undecided;
  check.worst.ended = true;
  check.worst.t = 1.25;
  const std::string text = campaign_summary(report, "gains.json");
  EXPECT_NE(text.find("undecided in 1 run  run 7 ended at (t, j) = (1.25, 0), before the claim "
                      "could be decided"),
            std::string::npos)
      << text;
  EXPECT_EQ(text.find("against"), text.rfind("against")) << "that of the other claim\n" << text;
  check.worst.judgement = claims::Judgement::violated;
  check.violations = 1;
  EXPECT_NE(campaign_summary(report, "gains.json")
                .find("violated in 1 run  run 7 ended at (t, j) = (1.25, 0), before its horizon"),
            std::string::npos);
}

TEST(CampaignText, AClaimWithoutAValueIsNotSaidToBeTooClose) {
  verify::Report report = two_undecided();
  report.first_undecided->finding.value = std::numeric_limits<double>::quiet_NaN();
  const std::string text = campaign_summary(report, "gains.json");
  EXPECT_NE(text.find("small at (t, j) = (3, 0): the claim has no value there"), std::string::npos)
      << text;
  for (const char* words : {"known to", "tolerance", "parted"})
    EXPECT_EQ(text.find(words), std::string::npos) << words << "\n" << text;
}

TEST(CampaignText, ADisputedViolationIsNotSaidToBeTooClose) {
  verify::Report report = two_undecided();
  report.first_undecided->finding.disputed = true;
  const std::string text = campaign_summary(report, "gains.json");
  EXPECT_NE(text.find("one computation of the run violates it"), std::string::npos) << text;
  EXPECT_EQ(text.find("known to"), std::string::npos) << text;
}

TEST(CampaignText, TheLineNamesTheWorstRun) {
  verify::Report report = two_undecided();
  report.undecided = 0;
  report.first_undecided.reset();
  report.verdict = model::CampaignVerdict::held;
  EXPECT_EQ(campaign_line(campaign_record(report, "")), "held in 20 runs, worst run 9");
}

}  // namespace
}  // namespace gainsmith::app
