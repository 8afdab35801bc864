#include "statistics/run_set.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace gainsmith::statistics {
namespace {

TEST(RunSet, IsTheRunsThatWereAdded) {
  std::mt19937 random(1);
  for (int round = 0; round < 200; ++round) {
    RunSet runs;
    std::set<std::uint64_t> expected;
    for (int k = 0; k < 12; ++k) {
      const std::uint64_t first = random() % 60, last = first + random() % 8;
      bool known = false;
      for (std::uint64_t run = first; run < last; ++run) known = known || expected.contains(run);
      EXPECT_EQ(runs.add({first, last}).count() > 0, known);
      if (known) continue;
      for (std::uint64_t run = first; run < last; ++run) expected.insert(run);
    }
    EXPECT_EQ(runs.count(), expected.size());
    std::uint64_t missing = 0;
    for (const RunRange& range : runs.missing_in({5, 50}))
      for (std::uint64_t run = range.first; run < range.last; ++run, ++missing)
        EXPECT_FALSE(expected.contains(run));
    std::uint64_t within = 0;
    for (const std::uint64_t run : expected) within += run >= 5 && run < 50 ? 1 : 0;
    EXPECT_EQ(missing + within, 45U);
    for (std::size_t k = 1; k < runs.ranges().size(); ++k)
      EXPECT_LT(runs.ranges()[k - 1].last, runs.ranges()[k].first);
  }
}

TEST(RunSet, SaysWhichRunsWereThere) {
  RunSet runs;
  runs.add({10, 20});
  runs.add({30, 40});
  EXPECT_EQ(runs.add({15, 35}), (RunRange{15, 20}));
  EXPECT_EQ(runs.count(), 20U);
}

TEST(RunSet, ShardsAreAllRunsOnce) {
  for (const std::uint64_t runs :
       {1ULL, 7ULL, 1000ULL, 100000ULL, 10000019ULL, 1000000000000000ULL})
    for (const std::uint64_t of : {1ULL, 2ULL, 3ULL, 8ULL, 1000ULL}) {
      std::uint64_t next = 0, least = runs, largest = 0;
      for (std::uint64_t k = 1; k <= of; ++k) {
        const RunRange shard = shard_of(runs, k, of);
        EXPECT_EQ(shard.first, next);
        next = shard.last;
        least = std::min(least, shard.count());
        largest = std::max(largest, shard.count());
      }
      EXPECT_EQ(next, runs);
      EXPECT_LE(largest - least, runs / of < 16 * 4096 ? 1U : 2 * 4096U);
      EXPECT_LE(static_cast<double>(largest), 1.07 * (static_cast<double>(runs / of) + 15));
    }
}

}  // namespace
}  // namespace gainsmith::statistics
