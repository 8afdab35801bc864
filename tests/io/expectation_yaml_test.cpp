#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "base/error.h"
#include "io/problem_text.h"

namespace gainsmith::io {
namespace {

TEST(Expectation, IsReadWhole) {
  const auto expect = read_problem(kProblem).expect;
  ASSERT_TRUE(expect);
  EXPECT_EQ(expect->verdict, "yes");
  EXPECT_EQ(expect->status, "optimal");
  EXPECT_EQ(expect->campaign, "held");
  EXPECT_EQ(expect->active_bounds, std::vector<std::string>{"g"});
  ASSERT_EQ(expect->values.size(), 2U);
  EXPECT_EQ(expect->values[0].name, "objective");
  EXPECT_EQ(expect->values[0].relative, 1e-3);
  EXPECT_FALSE(expect->values[0].absolute);
  EXPECT_EQ(expect->values[1].absolute, 0.1);
  EXPECT_EQ(expect->values[1].place, (Place{"p.yaml", 28, 5}));
}

TEST(Expectation, ACampaignMayBeExpectedToEndInEachOfItsVerdicts) {
  for (const std::string word : {"held", "violated", "undecided"}) {
    const auto read = read_problem(replaced(kProblem, "campaign: held", "campaign: " + word));
    EXPECT_EQ(read.expect->campaign, word);
  }
  try {
    read_problem(replaced(kProblem, "campaign: held", "campaign: undecidde"));
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(error.message().find("did you mean 'undecided'?"), std::string::npos)
        << error.message();
    EXPECT_GT(error.place().line, 0);
  }
}

TEST(Expectation, AnEmptyListOfBoundsIsNotTheSameAsNone) {
  const auto empty = read_problem(replaced(kProblem, "active_bounds: [g]", "active_bounds: []"));
  ASSERT_TRUE(empty.expect->active_bounds);
  EXPECT_TRUE(empty.expect->active_bounds->empty());
  const auto none = read_problem(replaced(kProblem, "  active_bounds: [g]\n", ""));
  EXPECT_FALSE(none.expect->active_bounds);
}

}  // namespace
}  // namespace gainsmith::io
