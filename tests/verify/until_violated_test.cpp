// Campaigns that end with their first violated run, and what their bound promises.
#include <gtest/gtest.h>

#include "statistics/sample_bounds.h"
#include "support/text_problem.h"
#include "verify/campaign.h"

namespace gainsmith::verify {
namespace {

using model::CampaignVerdict;
using model::StartKind;
using tests::TextProblem;

/// x grows at its jump where its start, uniform in [0, 1], is above 0.97.
TextProblem three_in_a_hundred() {
  TextProblem problem;
  problem.state("x", "scalar").flow({{"x", "0"}}).timer("1", "1", "1", "1");
  problem.jump({{"x", "x^2/0.97"}}).start("x", StartKind::box, {"0", "1"});
  problem.horizon("1.5").nonincreasing("falls", "x");
  return problem;
}

void expect_same(const Report& a, const Report& b) {
  EXPECT_EQ(a.verdict, b.verdict);
  EXPECT_EQ(a.runs, b.runs);
  EXPECT_EQ(a.violations, b.violations);
  EXPECT_EQ(a.worst_run, b.worst_run);
  EXPECT_EQ(a.checks[0].worst, b.checks[0].worst);
}

TEST(CampaignUntilViolated, EndsWithTheFirstViolatedRun) {
  TextProblem problem = three_in_a_hundred();
  const auto setup = make_setup(problem.instance(), problem.gains);
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const auto made = [&](std::uint64_t runs, unsigned threads, bool until) {
      return run_campaign(*setup, {runs, seed, threads, 0.95, until});
    };
    const Report report = made(100000, 1, true);
    ASSERT_EQ(report.verdict, CampaignVerdict::violated);
    EXPECT_EQ(report.violations, 1U);
    EXPECT_EQ(report.worst_run, report.runs - 1);
    EXPECT_FALSE(report.interrupted());
    const Report with_threads = made(100000, 2, true);
    expect_same(report, with_threads);
    expect_same(report, made(report.runs, 2, false));
    if (report.runs == 1) continue;
    const Report before = made(report.runs - 1, 2, true);
    EXPECT_EQ(before.verdict, CampaignVerdict::held);
    EXPECT_EQ(report.violation_probability, before.violation_probability);
  }
}

/// The promise of the bound, and that of a campaign as long as runs_for() says: each is broken in at
/// most one of twenty campaigns. Standard deviation of a share among 10,000: 0.0022.
TEST(CampaignUntilViolated, KeepsItsPromises) {
  constexpr int kCampaigns = 10000;
  constexpr double kProbability = 0.03, kSlightlyLess = 0.029;
  TextProblem problem = three_in_a_hundred();
  const auto setup = make_setup(problem.instance(), problem.gains);
  const std::uint64_t enough = statistics::runs_for(kSlightlyLess, 0.95);
  int beyond = 0, held = 0;
  for (std::uint64_t seed = 1; seed <= kCampaigns; ++seed) {
    const Report report = run_campaign(*setup, {enough, seed, 1, 0.95, true});
    beyond += report.violation_probability < kProbability ? 1 : 0;
    held += report.verdict == CampaignVerdict::held ? 1 : 0;
  }
  EXPECT_LT(beyond, 0.057 * kCampaigns);
  EXPECT_LT(held, 0.057 * kCampaigns);
  // 0.97^103 of them: the promise is no weaker than it must be.
  EXPECT_GT(held, 0.037 * kCampaigns);
}

}  // namespace
}  // namespace gainsmith::verify
