#include "forall/box.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "support/input_error.h"

namespace gainsmith::forall {
namespace {

TEST(BoxTest, HoldsTheCurve) {
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> number(-2, 2);
  for (int trial = 0; trial < 50; ++trial) {
    const std::vector<Atom> atoms = {{trial % 3, number(generator), 0, false},
                                     {0, number(generator), 1.0 + trial % 4, true},
                                     {trial % 2, number(generator), 2.5, false}};
    const double low = number(generator);
    const double high = low + 2 + number(generator);
    const Box box = box_of(atoms, "t", low, high, {});
    ASSERT_EQ(box.vertices.size(), 8U);
    for (std::size_t k = 0; k < atoms.size(); ++k) {
      const auto [least, most] = box.ranges[k];
      for (int i = 0; i <= 200; ++i) {
        const double value = evaluate(atoms[k], low + (high - low) * i / 200);
        EXPECT_GE(value, least - 1e-12 * std::abs(least));
        EXPECT_LE(value, most + 1e-12 * std::abs(most));
      }
      EXPECT_EQ(box.find(atoms[k]), static_cast<int>(k));
    }
    EXPECT_EQ(box.find({5, 0, 0, false}), -1);
  }
}

TEST(BoxTest, VerticesAreDifferentAndNamed) {
  const Box single = box_of({{0, -1, 0, false}}, "tau", 0, 2, {});
  EXPECT_EQ(single.labels, (std::vector<std::string>{"tau = 2", "tau = 0"}));
  const Box wave = box_of({{0, 0, 1, false}, {0, 0, 1, true}}, "s", 0, 10, {});
  EXPECT_EQ(wave.labels.front(), "cos(1*s) = -1, sin(1*s) = -1");
  EXPECT_EQ(wave.vertices.size(), 4U);
  const Box point = box_of({{1, 0, 0, false}, {2, 0, 0, false}}, "s", 3, 3, {});
  EXPECT_EQ(point.vertices, (std::vector<std::vector<double>>{{3, 9}}));
  const Box none = box_of({}, "s", 0, 1, {});
  EXPECT_EQ(none.vertices.size(), 1U);
  EXPECT_EQ(none.labels, std::vector<std::string>{""});
}

TEST(BoxTest, Refusals) {
  std::vector<Atom> many;
  for (int k = 0; k < 13; ++k) many.push_back({k + 1, 0, 0, false});
  const auto tooMany = tests::input_error([&] { box_of(many, "t", 0, 1, {"f.yaml", 3, 4}); });
  EXPECT_NE(tooMany.message().find("more than 4096 vertices"), std::string::npos);
  EXPECT_EQ(to_string(tooMany.place()), "f.yaml:3:4");
  const auto large = tests::input_error([] { box_of({{0, 900, 0, false}}, "t", 0, 1, {}); });
  EXPECT_NE(large.message().find("exp(900*t) is too large"), std::string::npos);
}

}  // namespace
}  // namespace gainsmith::forall
