#include "forall/plan.h"

#include <gtest/gtest.h>

#include "forall/variables.h"
#include "support/yaml_problem.h"

namespace gainsmith::forall {
namespace {

using testing::interval;
using testing::number;

TEST(PlanTest, IsWhatTheProblemAsksFor) {
  const std::string method =
      "problem: p\nmethod:\n  method: m\n  unknowns: {g: scalar}\n  require: {a: g > 0, b: g < "
      "1}\n";
  const Plan open = make_plan(*tests::YamlProblem(method).instance.design);
  ASSERT_EQ(open.inequalities.size(), 2U);
  EXPECT_EQ(open.inequalities[1].way, model::Way::automatic);
  EXPECT_EQ(open.slices, 1);
  EXPECT_FALSE(open.uses_exchange());
  EXPECT_EQ(open.points(), 0U);
  const Plan hull =
      make_plan(*tests::YamlProblem(method + "synthesis: {forall: {way: hull, slices: 6}}\n")
                     .instance.design);
  EXPECT_EQ(hull.inequalities[0].way, model::Way::hull);
  EXPECT_EQ(hull.slices, 6);
}

TEST(PlanTest, AnExchangeBeginsAtTheEndsAndTheMiddle) {
  const auto points = first_points({interval("tau", 1, 4)});
  ASSERT_EQ(points.size(), 3U);
  EXPECT_EQ(points[0].label, "tau = 1");
  EXPECT_EQ(points[1].label, "tau = 4");
  EXPECT_EQ(points[2].label, "tau = 2.5");
}

TEST(PlanTest, ABoxBeginsAtItsCornersAndItsCentre) {
  const auto points = first_points({interval("s", 0, 1), interval("t", 2, 4)});
  ASSERT_EQ(points.size(), 5U);
  EXPECT_EQ(points[0].label, "s = 0, t = 2");
  EXPECT_EQ(points[3].label, "s = 1, t = 4");
  EXPECT_EQ(points[4].label, "s = 0.5, t = 3");
}

TEST(PlanTest, AnIntervalOfOnePointAddsNoCorners) {
  EXPECT_EQ(first_points({interval("tau", 2, 2)}).size(), 1U);
  EXPECT_EQ(first_points({interval("s", 0, 1), interval("t", 2, 2)}).size(), 3U);
}

TEST(PlanTest, EveryElementOfASetHasPointsOfItsOwn) {
  const auto points =
      first_points({testing::set("k", {number(7), number(8)}), interval("tau", 0, 1)});
  ASSERT_EQ(points.size(), 6U);
  EXPECT_EQ(points[0].label, "k = 1, tau = 0");
  EXPECT_EQ(points[5].label, "k = 2, tau = 0.5");
}

TEST(PlanTest, APointIsAddedOnce) {
  const Domain domain = {interval("tau", 0, 2), testing::set("k", {number(7), number(8)})};
  Imposed imposed;
  const auto point = [](double tau, double k) {
    return extended(extended({}, "tau", tau), "k", k);
  };
  EXPECT_TRUE(add_point(imposed, domain, point(0.5, 7)));
  EXPECT_FALSE(add_point(imposed, domain, point(0.5 + 1e-9, 7)));
  EXPECT_TRUE(add_point(imposed, domain, point(0.5, 8)));
  EXPECT_TRUE(add_point(imposed, domain, point(0.5 + 1e-8, 7)));
  EXPECT_EQ(imposed.points.size(), 3U);
  Plan plan;
  plan.inequalities = {imposed, {}, imposed};
  EXPECT_TRUE(plan.uses_exchange());
  EXPECT_EQ(plan.points(), 6U);
}

/// The vertices of a polytope are imposed at every point, so a point has no element of it.
TEST(PlanTest, APointKeepsNoElementOfAPolytope) {
  const Domain domain = {interval("tau", 0, 2), testing::polytope("A", {number(1), number(2)})};
  Imposed imposed;
  EXPECT_TRUE(
      add_point(imposed, domain, extended(extended({}, "tau", 1), "A", number(2), "A = 2")));
  ASSERT_EQ(imposed.points.size(), 1U);
  EXPECT_EQ(imposed.points[0].values.count("A"), 0U);
  EXPECT_EQ(imposed.points[0].values.count("tau"), 1U);
}

}  // namespace
}  // namespace gainsmith::forall
