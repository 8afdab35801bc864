#include "base/stop.h"

#include <gtest/gtest.h>

#include "base/parallel.h"

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

}  // namespace
}  // namespace gainsmith
