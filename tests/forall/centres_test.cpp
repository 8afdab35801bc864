#include "forall/centres.h"

#include <gtest/gtest.h>

#include <random>

#include "forall/variables.h"

namespace gainsmith::forall {
namespace {

using testing::imposed_at;
using testing::interval;
using testing::number;
using testing::times_of;

TEST(CentresTest, NeighboursWithMultipliersHaveOneCentre) {
  const Domain domain = {interval("tau", 0, 10)};
  // Not in the order of the interval; 3 and 4 belong together, 6 has nothing, 8 is alone.
  const auto found = centres(imposed_at({8, 3, 6, 4, 0}), domain, {5, 3, 0, 1, 1e-9});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_DOUBLE_EQ(times_of(found)[0], 3.25);
  EXPECT_EQ(found[0].label, "tau = 3.25");
}

TEST(CentresTest, EveryRunHasItsOwn) {
  const Domain domain = {interval("tau", 0, 10)};
  const auto found = centres(imposed_at({1, 2, 3, 5, 6}), domain, {2, 2, 0, 1, 3});
  EXPECT_EQ(times_of(found), (std::vector<double>{1.5, 5.75}));
}

TEST(CentresTest, ElementsOfSetsAreApart) {
  const Domain domain = {testing::set("k", {number(7), number(8)}), interval("tau", 0, 10)};
  const std::vector<Point> elements = combinations(domain, model::Over::set);
  Imposed imposed;
  for (const double tau : {1.0, 2.0})
    for (const Point& element : elements) imposed.points.push_back(extended(element, "tau", tau));
  const auto found = centres(imposed, domain, {1, 0, 3, 4});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].label, "k = 1, tau = 1.75");
  EXPECT_EQ(found[0].values.at("k")(0, 0), 7);
}

TEST(CentresTest, BoxesOfIntervalsHaveNone) {
  const Domain domain = {interval("s", 0, 1), interval("t", 0, 1)};
  Imposed imposed;
  imposed.points = first_points(domain);
  EXPECT_TRUE(centres(imposed, domain, std::vector<double>(5, 1.0)).empty());
  EXPECT_TRUE(centres(imposed_at({1, 2}), {interval("tau", 0, 3)}, {}).empty());
}

/// Multipliers y_k of  f(t) = (t - t*)^2 >= 0, shared so that their first moment about t* vanishes,
/// as stationarity asks for: the centre is t* itself.
TEST(CentresTest, TheCentreOfBalancedMultipliersIsTheContactPoint) {
  std::mt19937 generator(31);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int trial = 0; trial < 50; ++trial) {
    const double contact = 1 + unit(generator);
    const double left = unit(generator);
    const double right = unit(generator);
    const auto found =
        centres(imposed_at({contact - left, contact + right}), {interval("tau", -1, 4)},
                {right / (left + right), left / (left + right)});
    // A side with almost no multiplier is not in contact.
    if (found.empty()) continue;
    EXPECT_NEAR(times_of(found)[0], contact, 1e-12);
  }
}

}  // namespace
}  // namespace gainsmith::forall
