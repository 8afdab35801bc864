#include "verify/tally.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

namespace gainsmith::verify {
namespace {

/// One of few values each, so that many runs are equally bad.
RunVerdict random_verdict(std::mt19937& random) {
  using enum model::CampaignVerdict;
  const auto one_of = [&](const auto& list) {
    return list[std::uniform_int_distribution<std::size_t>(0, list.size() - 1)(random)];
  };
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  RunVerdict verdict;
  verdict.judgement = one_of(std::vector{held, held, undecided, violated});
  verdict.termination =
      one_of(std::vector{claims::Termination::horizon, claims::Termination::horizon,
                         claims::Termination::broken_off, claims::Termination::lost});
  verdict.message = one_of(std::vector<std::string>{"", "a", "b"});
  verdict.repeated = one_of(std::vector{true, false});
  verdict.confirmed = verdict.repeated && verdict.judgement == violated;
  for (int c = 0; c < 2; ++c) {
    claims::Finding finding;
    finding.judgement = one_of(std::vector{held, undecided, violated});
    finding.score = one_of(std::vector{-kInfinity, -1.0, 0.0, 0.5, kInfinity});
    finding.value = std::uniform_real_distribution<double>(0, 1)(random);
    finding.floor = one_of(std::vector{0.0, 1e-9});
    verdict.findings.push_back(finding);
  }
  verdict.happened = {one_of(std::vector<char>{0, 0, 0, 1}), one_of(std::vector<char>{0, 1})};
  return verdict;
}

std::vector<Tally> random_tallies(std::mt19937& random, std::size_t count) {
  std::vector<Tally> tallies;
  for (std::size_t run = 0; run < count; ++run) {
    tallies.push_back(tally_of(run, random_verdict(random)));
    tallies.back().open[run % packs::kWhys] = run % 3;
    tallies.back().careful = run % 2;
  }
  return tallies;
}

Tally sum_in_order(const std::vector<Tally>& tallies) {
  Tally sum;
  for (const Tally& tally : tallies) add(tally, sum);
  return sum;
}

/// Two of the tallies become their sum, until one is left.
Tally sum_at_random(std::vector<Tally> tallies, std::mt19937& random) {
  while (tallies.size() > 1) {
    std::shuffle(tallies.begin(), tallies.end(), random);
    add(tallies.back(), tallies.front());
    tallies.pop_back();
  }
  return tallies.front();
}

TEST(Tally, IsTheSameForAnyOrderAndGrouping) {
  std::mt19937 random(3);
  for (int round = 0; round < 50; ++round) {
    const std::vector<Tally> tallies = random_tallies(random, 40);
    const Tally expected = sum_in_order(tallies);
    EXPECT_EQ(expected.runs, 40U);
    for (int k = 0; k < 5; ++k) EXPECT_EQ(sum_at_random(tallies, random), expected) << round;
  }
}

TEST(Tally, OfNoRunsChangesNothing) {
  std::mt19937 random(4);
  const Tally one = random_tallies(random, 1).front();
  Tally sum;
  add(one, sum);
  add({}, sum);
  EXPECT_EQ(sum, one);
}

TEST(Tally, TheFirstOfEquallyBadRunsIsTheWorst) {
  RunVerdict verdict;
  verdict.findings.resize(1);
  Tally sum = tally_of(7, verdict);
  add(tally_of(3, verdict), sum);
  add(tally_of(5, verdict), sum);
  EXPECT_EQ(sum.worst->run, 3U);
  EXPECT_EQ(sum.claims[0].run, 3U);
}

TEST(Tally, CountsAsTheRunsSay) {
  std::mt19937 random(5);
  Tally sum;
  std::uint64_t violations = 0, unfinished = 0;
  std::vector<std::uint64_t> confirmed;
  for (std::uint64_t run = 0; run < 200; ++run) {
    const RunVerdict verdict = random_verdict(random);
    violations += verdict.judgement == claims::Judgement::violated ? 1 : 0;
    unfinished += verdict.unfinished() ? 1 : 0;
    if (verdict.confirmed) confirmed.push_back(run);
    add(tally_of(run, verdict), sum);
  }
  EXPECT_EQ(sum.violations, violations);
  EXPECT_EQ(sum.unfinished, unfinished);
  EXPECT_EQ(sum.confirmed, confirmed);
}

}  // namespace
}  // namespace gainsmith::verify
