#include "base/stop.h"

#include <gtest/gtest.h>

#include <atomic>

#include "base/parallel.h"
#include "support/stop.h"

namespace gainsmith {
namespace {

TEST(Allowance, EndsWhatSpendsMore) {
  const Allowance allowance(1);
  spend(0.75);
  EXPECT_THROW(spend(0.5), OutOfAllowance);
  EXPECT_DOUBLE_EQ(allowance.spent(), 1.25);
}

TEST(Allowance, CountsForTheOneAroundIt) {
  const Allowance outer(1);
  {
    const Allowance inner(0.5);
    EXPECT_THROW(spend(0.6), OutOfAllowance);
  }
  spend(0.3);
  EXPECT_THROW(spend(0.3), OutOfAllowance);
}

TEST(Allowance, HoldsForTheThreadsOfALoop) {
  const Allowance allowance(10);
  parallel_for(100, 4, [](std::size_t) { spend(0.0625); });
  EXPECT_DOUBLE_EQ(allowance.spent(), 6.25);
  EXPECT_THROW(parallel_for(100, 4, [](std::size_t) { spend(0.0625); }), OutOfAllowance);
}

TEST(Allowance, NothingIsLimitedWithoutOne) { EXPECT_NO_THROW(spend(1e9)); }

TEST(Stop, EndsWhatIsNotConcluding) {
  const tests::StopInTest stop;
  EXPECT_NO_THROW(check_stop());
  request_stop();
  EXPECT_THROW(check_stop(), Stopped);
  EXPECT_THROW(spend(0), Stopped);
  EXPECT_THROW(parallel_for(4, 2, [](std::size_t) {}), Stopped);
  {
    const Concluding concluding;
    const Allowance allowance(1);
    EXPECT_NO_THROW(spend(0.5));
    EXPECT_NO_THROW(parallel_for(4, 2, [](std::size_t) { check_stop(); }));
    EXPECT_THROW(spend(0.75), OutOfAllowance);
  }
  EXPECT_THROW(check_stop(), Stopped);
}

TEST(Stop, EndsTheLoopThatItReaches) {
  for (const unsigned threads : {1U, 4U}) {
    const tests::StopInTest stop;
    std::atomic<int> done = 0;
    const auto body = [&](std::size_t) {
      if (++done == 10) request_stop();
    };
    EXPECT_THROW(parallel_for(100'000, threads, body), Stopped);
    EXPECT_LT(done, 100'000);
  }
}

}  // namespace
}  // namespace gainsmith
