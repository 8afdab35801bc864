#include "linear/length_table.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

namespace gainsmith::linear::length_tables {
namespace {

double evaluated(const LengthTable& table, std::size_t f, double length) {
  const double sigma = (length - table.middle) * table.scale;
  double sum = 0;
  for (std::size_t k = table.functions[f].powers.size(); k-- > 0;)
    sum = sum * sigma + table.functions[f].powers[k];
  return sum;
}

TEST(LengthTable, IsWithinItsErrors) {
  const WideFunctions functions = [](const Decimal100& s) {
    return std::vector<Decimal100>{exp(Decimal100(-7) * s), Decimal100(sin(s * Decimal100(9))),
                                   s * s * s, Decimal100(2.5)};
  };
  const auto wide = make_wide_table(0.3, 1.7, functions);
  ASSERT_TRUE(wide);
  const LengthTable table = rounded(*wide);
  EXPECT_EQ(table.functions[2].powers.size(), 4U);
  EXPECT_EQ(table.functions[3].powers.size(), 1U);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> length(0.3, 1.7);
  for (int k = 0; k < 500; ++k) {
    const double s = k == 0 ? 0.3 : k == 1 ? 1.7 : length(random);
    const std::vector<Decimal100> truth = functions(Decimal100(s));
    for (std::size_t f = 0; f < truth.size(); ++f) {
      const Decimal100 error = truth[f] - Decimal100(evaluated(table, f, s));
      EXPECT_LE(std::abs(static_cast<double>(error)), table.functions[f].error) << f;
      EXPECT_LE(std::abs(static_cast<double>(truth[f])), table.functions[f].size) << f;
      EXPECT_LE(table.functions[f].error, 1e-13 * table.functions[f].size) << f;
    }
  }
}

TEST(LengthTable, OfOneLengthIsAConstant) {
  const auto wide = make_wide_table(
      0.5, 0.5, [](const Decimal100& s) { return std::vector<Decimal100>{exp(s)}; });
  ASSERT_TRUE(wide);
  EXPECT_EQ(wide->scale, 0);
  EXPECT_EQ(rounded(*wide).functions[0].powers, std::vector<double>{std::exp(0.5)});
}

TEST(LengthTable, RefusesWhatItDoesNotFollow) {
  const auto follows = [](double rate) {
    return make_wide_table(0, 1,
                           [&](const Decimal100& s) {
                             return std::vector<Decimal100>{exp(Decimal100(-rate) * s)};
                           })
        .has_value();
  };
  EXPECT_TRUE(follows(1));
  EXPECT_TRUE(follows(60));
  EXPECT_FALSE(follows(1e4));
  // What no coefficient of the last quarter shows: a kink.
  EXPECT_FALSE(make_wide_table(0, 1, [](const Decimal100& s) {
    return std::vector<Decimal100>{Decimal100(abs(s - Decimal100(0.3)))};
  }));
}

TEST(LengthTable, WhatIsRoundingIsNothing) {
  const auto wide = make_wide_table(0, 1, [](const Decimal100& s) {
    const Decimal100 third = Decimal100(1) / Decimal100(3);
    return std::vector<Decimal100>{s, Decimal100((s + third) - third - s)};
  });
  ASSERT_TRUE(wide);
  EXPECT_EQ(wide->powers[1].size(), 1U);
  EXPECT_EQ(wide->powers[1][0], Decimal100(0));
}

TEST(PieceTable, FollowsAFastDecay) {
  const auto function = [](const Decimal100& s) {
    return std::vector<Decimal100>{exp(Decimal100(-50000) * s) + exp(-s), Decimal100(0)};
  };
  const auto table = make_piece_table(0, 1, 30.0 / 50000, function);
  ASSERT_TRUE(table);
  EXPECT_EQ(table->pieces.size(), table->ends.size());
  EXPECT_EQ(table->ends.back(), 1);
  for (double s = 1e-7; s <= 1; s *= 1.01)
    for (const double at : {s, 1 - s}) {
      std::array<double, 4> values{};
      table->values(at, values.data(), 2);
      EXPECT_LE(std::abs(static_cast<double>(function(Decimal100(at))[0] - Decimal100(values[0]))),
                table->whole.functions[0].error);
      EXPECT_EQ(values[2], 0);
    }
  EXPECT_LE(table->whole.functions[0].error, 1e-12);
  EXPECT_FALSE(make_piece_table(0, 1, 1, function));
}

TEST(PieceTable, OfOneLengthHasOnePiece) {
  const auto function = [](const Decimal100& s) { return std::vector<Decimal100>{s}; };
  for (const double length : {0.0, 0.3}) {
    const auto table = make_piece_table(length, length, 0.01, function);
    ASSERT_TRUE(table);
    EXPECT_EQ(table->pieces.size(), 1U);
  }
}

}  // namespace
}  // namespace gainsmith::linear::length_tables
