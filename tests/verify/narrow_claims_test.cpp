// Claims and figures whose texts branch for less than a look, or whose evaluation cancels.
#include <gtest/gtest.h>

#include <cmath>
#include <ostream>
#include <random>
#include <string>

#include "base/number.h"
#include "io/problem_text.h"
#include "model/bind.h"
#include "verify/campaign.h"
#include "verify/expected_run.h"

namespace gainsmith::verify {
namespace {

using model::CampaignVerdict;

/// x = t, y = exp(-t) and r' = -r + 0.1 sin(r), which makes the whole flow one that is integrated.
model::Instance instance_of(const std::string& claims, bool integrated,
                            const std::string& more = "") {
  const std::string plant = integrated ? R"(    state:
      x: {shape: scalar, start: 0}
      y: {shape: scalar, start: 1}
      r: {shape: scalar, start: 1}
    flow: {x: "1", y: -y, r: -r + 0.1*sin(r)}
)"
                                       : R"(    state:
      x: {shape: scalar, start: 0}
      y: {shape: scalar, start: 1}
    flow: {x: "1", y: -y}
)";
  return model::bind(io::read_problem("problem: p\nmethod:\n  method: m\n" + more + "  plant:\n" +
                                      plant + "  claims: " + claims +
                                      "\ncampaign: {runs: 1, horizon: 3}\n"));
}

CampaignVerdict verdict_of(const std::string& claim, bool integrated) {
  CampaignOptions options;
  options.threads = 1;
  return run_campaign(instance_of("{c: {" + claim + "}}", integrated), model::Gains{}, options)
      .verdict;
}

struct Case {
  std::string claim;
  CampaignVerdict verdict;
};
void PrintTo(const Case& one, std::ostream* out) { *out << one.claim; }

class NarrowClaims : public testing::TestWithParam<Case> {};

TEST_P(NarrowClaims, AreJudgedAsTheyAre) {
  for (const bool integrated : {false, true})
    EXPECT_EQ(verdict_of(GetParam().claim, integrated), GetParam().verdict) << integrated;
}

const std::string kBand = "where(x > 1.26, where(x < 1.2601, 1, 0), 0)";
const std::string kTent = "max(0, 1 - abs(x - 1.2345)/0.001)";

INSTANTIATE_TEST_SUITE_P(
    Jumps, NarrowClaims,
    testing::Values(
        Case{"below: \"" + kBand + "\", bound: 0.5", CampaignVerdict::violated},
        Case{"below: \"" + kBand + "\", bound: 1.1", CampaignVerdict::held},
        Case{"nonincreasing: \"y + 0.1*" + kBand + "\"", CampaignVerdict::violated},
        Case{"nonincreasing: \"y - 0.1*sign(x - 1.1)\"", CampaignVerdict::held},
        Case{"below: sign(x - 1) - sign(x - 1.001), bound: 1.5", CampaignVerdict::violated},
        Case{"above: floor(10*x) - 10*x, bound: -0.999", CampaignVerdict::violated},
        Case{"above: floor(10*x) - 10*x, bound: -1.0001", CampaignVerdict::held},
        Case{"below: \"mod(x, 0.07)\", bound: 0.0699", CampaignVerdict::violated},
        Case{"below: \"mod(x, 0.07)\", bound: 0.0701", CampaignVerdict::held},
        Case{"below: \"" + kBand + "\", bound: 0.5, after: 1.2602", CampaignVerdict::held},
        Case{"above: \"atan2(x - 2, -1)\", bound: -3.1415", CampaignVerdict::violated}));

INSTANTIATE_TEST_SUITE_P(
    Kinks, NarrowClaims,
    testing::Values(Case{"below: \"" + kTent + "\", bound: 0.9999", CampaignVerdict::violated},
                    Case{"below: \"" + kTent + "\", bound: 1.0001", CampaignVerdict::held},
                    Case{"nonincreasing: \"y + " + kTent + "\"", CampaignVerdict::violated},
                    Case{"below: \"rate(" + kTent + ")\", bound: 900", CampaignVerdict::violated},
                    Case{"below: \"rate(" + kTent + ")\", bound: 1000.1", CampaignVerdict::held},
                    Case{"above: \"rate(abs(x - 1))\", bound: -1.001", CampaignVerdict::held},
                    Case{"nonincreasing: \"y + 0*" + kTent + "\"", CampaignVerdict::held}));

// An equation whose evaluation rounds is neither held nor violated for certain, whatever else there
// is.
INSTANTIATE_TEST_SUITE_P(
    Cancellation, NarrowClaims,
    testing::Values(Case{"above: (1e15 + y) - 1e15 - y, bound: 0", CampaignVerdict::undecided},
                    Case{"above: (1e15 + y) - 1e15 - y, bound: 0.001", CampaignVerdict::undecided},
                    Case{"below: exp(log(y)) - y, bound: 0", CampaignVerdict::undecided},
                    Case{"below: t*0.1*10 - t, bound: 0", CampaignVerdict::undecided},
                    Case{"below: rate(y) + exp(-t) + 0*rate(abs(x - 1)), bound: 0",
                         CampaignVerdict::undecided},
                    Case{"above: (1e15 + y) - 1e15 - y, bound: -2", CampaignVerdict::held}));

TEST(NarrowClaims, RandomBandsAreFound) {
  std::mt19937 random(11);
  for (int trial = 0; trial < 40; ++trial) {
    const double at = std::uniform_real_distribution<>(0.01, 2.9)(random);
    const double width = std::pow(10, std::uniform_real_distribution<>(-7, -2)(random));
    const std::string low = brief(at, 17);
    const std::string high = brief(at + width, 17);
    const std::string band = "where(x > " + low + ", where(x <= " + high + ", 1, 0), 0)";
    EXPECT_EQ(verdict_of("below: \"" + band + "\", bound: 0.5", trial % 2 == 1),
              CampaignVerdict::violated)
        << band;
  }
}

TEST(NarrowFigures, APeakIsFound) {
  model::Instance instance =
      model::bind(io::read_problem("problem: p\nmethod:\n  method: m\n"
                                   "  plant: {state: {x: {shape: scalar, start: 0}}, flow: {x: "
                                   "\"1\"}}\ncampaign: {horizon: 3}\nexpect:\n  run:\n"
                                   "    - {peak: \"" +
                                   kTent +
                                   "\", is: 1, absolute: 1e-9}\n"
                                   "    - {settles: \"" +
                                   kTent + "\", below: 0.5, is: 1.235, absolute: 1e-9}\n"));
  const RunDifferences found = run_differences(instance, model::Gains{}, {});
  EXPECT_EQ(found.figures, 2U);
  EXPECT_TRUE(found.different.empty()) << found.different.front();
  EXPECT_TRUE(found.undecided.empty());
}

}  // namespace
}  // namespace gainsmith::verify
