// A campaign is the same in one piece and in parts that went through JSON.
#include "gainsmith/campaign_parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "gainsmith/campaign_json.h"
#include "gainsmith/campaign_text.h"
#include "io/json/campaign_json.h"
#include "support/text_problem.h"
#include "verify/campaign.h"

namespace gainsmith::app {
namespace {

using tests::column;
using tests::scalar;
using tests::TextProblem;

std::string report_text(const verify::Report& report) {
  return io::to_text(io::to_json(campaign_record(report, ""))) + campaign_summary(report, "gains");
}

verify::CampaignPart through_json(const verify::CampaignPart& part) {
  const io::Json written = {
      {"facts", to_json(part.facts)}, {"runs", runs_json(part)}, {"repeats", repeats_json(part)}};
  const io::Json document = io::parse_json(io::to_text(written), "part.json");
  const io::JsonReader reader(document, "part.json");
  verify::CampaignPart read;
  read.facts = facts_from(reader.at("facts"));
  read_runs(reader.at("runs"), read);
  read_repeats(reader.at("repeats"), read);
  reader.finish();
  EXPECT_EQ(read, part);
  return read;
}

/// Shards of some campaign, made in two steps each, and added in a random order.
std::string merged_text(const verify::Campaign& campaign, std::uint64_t shards,
                        std::mt19937& random) {
  std::vector<verify::CampaignPart> parts;
  for (std::uint64_t k = 1; k <= shards; ++k) {
    const statistics::RunRange range = statistics::shard_of(campaign.asked(), k, shards);
    verify::CampaignPart part = campaign.begin();
    campaign.make_runs({range.first, range.first + range.count() / 3}, part);
    campaign.make_runs(range, part);
    campaign.repeat_worst(part);
    parts.push_back(through_json(part));
  }
  std::shuffle(parts.begin(), parts.end(), random);
  for (std::size_t k = 1; k < parts.size(); ++k)
    EXPECT_EQ(add(parts[k], parts.front()).count(), 0U);
  return report_text(conclude(parts.front()));
}

void expect_same_in_shards(const TextProblem& problem, model::CampaignVerdict verdict,
                           std::uint64_t runs) {
  const auto setup = verify::make_setup(problem.instance(), problem.gains);
  const verify::CampaignOptions options{runs, {}, 2, 0.95};
  const verify::Report report = run_campaign(*setup, options);
  EXPECT_EQ(report.verdict, verdict);
  const std::string expected = report_text(report);
  std::mt19937 random(1);
  const verify::Campaign campaign(*setup, options);
  for (const std::uint64_t shards : {1, 3, 8, 60})
    EXPECT_EQ(merged_text(campaign, shards, random), expected) << shards;
}

TEST(CampaignParts, OfLinearRunsThatHold) {
  TextProblem problem =
      tests::sampled_data("1.1", column({3.68, -24.47}), column({0.104, -0.948}), scalar(-25.93));
  problem.horizon("20").shrinks("shrinks", "norm(e)", "0.01");
  expect_same_in_shards(problem, model::CampaignVerdict::held, 3000);
}

TEST(CampaignParts, OfLinearRunsThatViolate) {
  TextProblem problem =
      tests::sampled_data("1.1", column({3.68, -24.47}), column({0.040, -0.364}), scalar(-11.47));
  problem.horizon("44").shrinks("shrinks", "norm(e)", "0.5");
  problem.law(model::LawKind::constant, {"T1"}).law(model::LawKind::constant, {"T2"});
  expect_same_in_shards(problem, model::CampaignVerdict::violated, 30);
  expect_same_in_shards(problem, model::CampaignVerdict::violated, 200);
}

TEST(CampaignParts, OfIntegratedRuns) {
  TextProblem problem;
  problem.state("x", "scalar").flow({{"x", "-x^3"}}).timer("0.5", "1", "0", "1");
  problem.jump({{"x", "0.9*x"}}).horizon("10").nonincreasing("falls", "x^2");
  expect_same_in_shards(problem, model::CampaignVerdict::held, 200);
  problem.cost("dear", "x^2/2", "1.5*x^4", "0.2*x^2");
  expect_same_in_shards(problem, model::CampaignVerdict::violated, 40);
}

TEST(CampaignParts, OfRunsThatAreUndecided) {
  TextProblem problem;
  problem.state("x", "2").flow({{"x", "[x(2); -sin(x(1))]"}}).timer("1", "1", "1", "1");
  problem.horizon("5").nonincreasing("energy", "x(2)^2/2 - cos(x(1)) + 1");
  expect_same_in_shards(problem, model::CampaignVerdict::undecided, 5);
}

TEST(CampaignParts, OfRunsThatEscape) {
  TextProblem problem;
  problem.state("x", "scalar").flow({{"x", "x^2"}}).timer("1", "1", "1", "1");
  problem.horizon("5").shrinks("small", "abs(x)", "2");
  problem.start("x", model::StartKind::box, {"-1", "1"});
  expect_same_in_shards(problem, model::CampaignVerdict::violated, 40);
}

TEST(CampaignParts, KeepTheBitsOfEveryNumber) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::mt19937_64 random(2);
  std::vector<double> values = {kInfinity, -kInfinity, -0.0, 0.0, 5e-324, 1e300, 0.1};
  for (int k = 0; k < 200; ++k) {
    const std::uint64_t bits = random();
    const double value = std::bit_cast<double>(bits);
    if (std::isfinite(value)) values.push_back(value);
  }
  verify::CampaignPart part;
  part.facts.claims = {{"claim", model::ClaimKind::below, {}}};
  for (const double value : values) {
    verify::RunVerdict verdict;
    claims::Finding finding;
    finding.score = finding.value = finding.bound = finding.rounding = value;
    finding.judgement = claims::Judgement::undecided;
    verdict.judgement = claims::Judgement::undecided;
    verdict.findings = {finding};
    part.runs = {};
    part.runs.add({7, 8});
    part.tally = tally_of(7, verdict);
    const verify::CampaignPart read = through_json(part);
    EXPECT_EQ(std::signbit(read.tally.claims[0].worst.score), std::signbit(value)) << value;
  }
}

TEST(CampaignParts, WithRunsThatAreThereAreNotAdded) {
  TextProblem problem;
  problem.state("x", "scalar").flow({{"x", "-x"}}).timer("1", "1", "1", "1").horizon("3");
  problem.nonincreasing("falls", "x^2");
  const auto setup = verify::make_setup(problem.instance(), problem.gains);
  const verify::Campaign campaign(*setup, {10, {}, 1, 0.95});
  verify::CampaignPart first = campaign.begin(), second = campaign.begin();
  campaign.make_runs({0, 6}, first);
  campaign.make_runs({4, 10}, second);
  const verify::CampaignPart before = first;
  EXPECT_EQ(add(second, first), (statistics::RunRange{4, 6}));
  EXPECT_EQ(first, before);
}

}  // namespace
}  // namespace gainsmith::app
