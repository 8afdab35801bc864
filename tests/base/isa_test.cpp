#include "base/isa.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <random>

namespace gainsmith {
namespace {

TEST(Isa, KnowsThreeNames) {
  EXPECT_TRUE(has_isa("v2"));
  EXPECT_FALSE(has_isa("v5"));
  EXPECT_FALSE(has_isa(""));
  EXPECT_TRUE(has_isa("v3") || !has_isa("v4"));
}

/// The rest of a product tells an operation that is rounded twice.
TEST(Isa, AFusedOperationIsRoundedOnce) {
  EXPECT_EQ(fused_multiply_add(1 + 0x1p-30, 1 - 0x1p-30, -1.0), -0x1p-60);
  std::mt19937_64 bits(1);
  int compared = 0;
  for (int trial = 0; trial < 100000; ++trial) {
    const auto a = std::bit_cast<double>(static_cast<std::uint64_t>(bits()));
    const auto b = std::bit_cast<double>(static_cast<std::uint64_t>(bits()));
    const double c =
        trial % 2 == 0 ? -a * b : std::bit_cast<double>(static_cast<std::uint64_t>(bits()));
    const double expected = std::fma(a, b, c), found = fused_multiply_add(a, b, c);
    if (std::isnan(expected)) {
      EXPECT_TRUE(std::isnan(found));
      continue;
    }
    EXPECT_EQ(std::bit_cast<std::uint64_t>(found), std::bit_cast<std::uint64_t>(expected));
    ++compared;
  }
  EXPECT_GT(compared, 50000);
}

}  // namespace
}  // namespace gainsmith
