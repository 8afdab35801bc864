#include "claims/independence.h"

#include <gtest/gtest.h>

#include "support/event_problem.h"

namespace gainsmith::claims {
namespace {

using tests::EventProblem;

/// Two observers with an event each, and a clock of the plant; `map` is that of the second.
bool are_apart(const std::string& condition, const std::string& map, std::size_t one,
               std::size_t other) {
  EventProblem problem;
  problem.state("x", {}, "1").flow("x", "-x");
  problem.every("tick", "1", "1").jump("tick", {{"x", "x/2"}});
  problem.observer("a").state("a.z", {}, "0").when("first", "a.z >= 1");
  problem.jump("first", {{"a.z", "a.z - 1"}});
  problem.observer("b").state("b.z", {}, "0").when("second", condition);
  problem.jump("second", {{"b.z", map}});
  return Independence(problem.system().dynamics)(one, other);
}

TEST(Independence, IsOfEventsThatShareNoVariable) {
  EXPECT_TRUE(are_apart("b.z >= 1", "b.z - 1", 1, 2));
  EXPECT_TRUE(are_apart("b.z >= 1", "b.z - 1", 2, 1));
  EXPECT_TRUE(are_apart("b.z >= 1", "b.z - 1", 0, 2));
}

TEST(Independence, EndsWhereOneReadsWhatTheOtherWrites) {
  EXPECT_FALSE(are_apart("b.z >= 1", "b.z - x", 0, 2)) << "in its map";
  EXPECT_FALSE(are_apart("b.z >= x", "b.z - 1", 0, 2)) << "in its condition";
  EXPECT_FALSE(are_apart("b.z >= x", "b.z - 1", 2, 0));
  EXPECT_TRUE(are_apart("b.z >= x", "b.z - x", 1, 2));
}

TEST(Independence, IsOfNoneThatReadsTheNumberOfJumps) {
  EXPECT_FALSE(are_apart("b.z >= 1", "b.z + j", 1, 2));
  EXPECT_FALSE(are_apart("b.z >= 1", "b.z + j", 2, 0));
}

TEST(Independence, IsNotOfAnEventAndItself) {
  EXPECT_FALSE(are_apart("b.z >= 1", "b.z - 1", 2, 2));
}

}  // namespace
}  // namespace gainsmith::claims
