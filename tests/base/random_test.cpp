#include "base/random.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <set>

namespace gainsmith {
namespace {

using Words = std::array<std::uint32_t, 4>;

// Random123's kat_vectors, philox4x32 with 10 rounds.
TEST(Philox, AgreesWithThePublishedVectors) {
  constexpr std::uint32_t kOnes = 0xFFFFFFFFU;
  EXPECT_EQ(philox4x32({0, 0, 0, 0}, {0, 0}),
            (Words{0x6627e8d5U, 0xe169c58dU, 0xbc57ac4cU, 0x9b00dbd8U}));
  EXPECT_EQ(philox4x32({kOnes, kOnes, kOnes, kOnes}, {kOnes, kOnes}),
            (Words{0x408f276dU, 0x41c83b0eU, 0xa20bc7c6U, 0x6d5451fdU}));
  EXPECT_EQ(
      philox4x32({0x243f6a88U, 0x85a308d3U, 0x13198a2eU, 0x03707344U}, {0xa4093822U, 0x299f31d0U}),
      (Words{0xd16cfe09U, 0x94fdcceb, 0x5001e420U, 0x24126ea1U}));
}

TEST(RandomStream, IsPhiloxOfSeedRunAndDraw) {
  const std::uint64_t seed = 0x123456789ABCDEF0U;
  const std::uint64_t run = 0xFEDCBA9876543210U;
  const std::uint64_t draw = 0x0F1E2D3C4B5A6978U;
  const Words words =
      philox4x32({0x4B5A6978U, 0x0F1E2D3CU, 0x76543210U, 0xFEDCBA98U}, {0x9ABCDEF0U, 0x12345678U});
  const std::uint64_t bits = (static_cast<std::uint64_t>(words[0]) << 32U | words[1]) >> 11U;
  EXPECT_EQ(RandomStream(seed, run).uniform_at(draw), std::ldexp(static_cast<double>(bits), -53));
}

TEST(RandomStream, DrawsInTurnAreTheDrawsByNumber) {
  RandomStream stream(7, 3);
  const RandomStream same(7, 3);
  for (std::uint64_t draw = 0; draw < 100; ++draw) {
    EXPECT_EQ(stream.draws(), draw);
    EXPECT_EQ(stream.uniform(), same.uniform_at(draw));
  }
}

TEST(RandomStream, UniformLiesInTheHalfOpenUnitIntervalOnMultiplesOf2ToMinus53) {
  RandomStream stream(1, 0);
  for (int i = 0; i < 100000; ++i) {
    const double value = stream.uniform();
    ASSERT_GE(value, 0.0);
    ASSERT_LT(value, 1.0);
    const double scaled = std::ldexp(value, 53);
    ASSERT_EQ(scaled, std::floor(scaled));
  }
}

// Mean 1/2, variance 1/12, no correlation between neighbours; five standard deviations of each
// estimate allowed: sd(mean) = sqrt(1/12/N), sd(variance) = sqrt(1/180/N), sd(product) =
// 1/12/sqrt(N).
TEST(RandomStream, HasTheMomentsOfTheUniformLaw) {
  constexpr int kDraws = 400000;
  RandomStream stream(2024, 11);
  double sum = 0;
  double squares = 0;
  double products = 0;
  double before = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double centred = stream.uniform() - 0.5;
    sum += centred;
    squares += centred * centred;
    products += centred * before;
    before = centred;
  }
  const double root = std::sqrt(static_cast<double>(kDraws));
  EXPECT_NEAR(sum / kDraws, 0, 5 * std::sqrt(1.0 / 12) / root);
  EXPECT_NEAR(squares / kDraws, 1.0 / 12, 5 * std::sqrt(1.0 / 180) / root);
  EXPECT_NEAR(products / kDraws, 0, 5 * (1.0 / 12) / root);
}

TEST(RandomStream, SeedsAndRunsGiveDifferentStreams) {
  std::set<double> first;
  for (std::uint64_t seed = 0; seed < 30; ++seed)
    for (std::uint64_t run = 0; run < 30; ++run)
      first.insert(RandomStream(seed, run).uniform_at(0));
  EXPECT_EQ(first.size(), 900U);
}

}  // namespace
}  // namespace gainsmith
