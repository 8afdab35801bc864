#include "lmi/margins.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include "support/yaml_problem.h"

namespace gainsmith::lmi {
namespace {

/// One unknown number x in one inequality, "all".
class MarginsTest : public ::testing::Test {
 protected:
  MarginsTest() { pose("x > 1"); }

  void pose(const std::string& require, const std::string& more = "") {
    yaml_ = std::make_unique<tests::YamlProblem>(
        "problem: p\nmethod:\n  method: m\n  unknowns: {x: scalar}\n  require:\n    all: " +
        require + "\n" + more);
    of_ = std::make_unique<Inequalities>(yaml_->instance);
    plan_ = forall::make_plan(of_->design());
    lmi_ = compile(*of_, plan_);
  }

  Margins at(double x, double required = 1e-7) const {
    return compute_margins(*of_, lmi_, plan_, std::vector<double>(lmi_.blocks.size(), 2.0), false,
                           required, {x});
  }

  std::unique_ptr<tests::YamlProblem> yaml_;
  std::unique_ptr<Inequalities> of_;
  forall::Plan plan_;
  Lmi lmi_;
};

TEST_F(MarginsTest, AreTheSmallestEigenvalueInUnitsOfTheScale) {
  const Margins found = at(1.5);
  ASSERT_EQ(found.margins.size(), 1U);
  EXPECT_DOUBLE_EQ(found.margins[0].smallest_eigenvalue, 0.5);
  EXPECT_DOUBLE_EQ(found.margins[0].reached, 0.25);
  EXPECT_TRUE(is_kept(found.margins[0]));
  EXPECT_TRUE(found.open.empty());
  EXPECT_FALSE(found.searched);
  EXPECT_FALSE(is_kept(at(1.5, 0.3).margins[0]));
  EXPECT_TRUE(is_kept(at(1.5, 0.2525).margins[0]));  // 1 % less is enough
  EXPECT_FALSE(is_kept(at(0.5).margins[0]));
}

/// The text counts whatever the blocks say, and the blocks whatever the text says.
TEST_F(MarginsTest, AMistakeInTheBlocksShowsUp) {
  ASSERT_EQ(lmi_.blocks[0].terms[0].first, 0);
  lmi_.blocks[0].terms[0].second *= -1;  // x + 1 > 0
  EXPECT_DOUBLE_EQ(at(0.5).margins[0].smallest_eigenvalue, -0.5);
  lmi_.blocks[0].terms[0].second *= -3;  // x - 3 > 0
  EXPECT_DOUBLE_EQ(at(2).margins[0].smallest_eigenvalue, -1);
}

TEST_F(MarginsTest, WhatIsNoNumberIsNotKept) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const char* require : {"x > 1", "{forall: \"k in {1, 2}\", that: \"[x, 1; 1, k] > 0\"}"}) {
    pose(require);
    try {
      EXPECT_FALSE(is_kept(at(nan).margins[0])) << require;
    } catch (const InputError&) {
      // Refused by the arithmetic: that is no yes either.
    }
  }
}

TEST_F(MarginsTest, WithoutDerivativesItIsSearchedBetweenThePoints) {
  pose("{forall: \"t in [0.1, 4]\", that: \"x > sqrt(t)\"}", "synthesis: {forall: exchange}\n");
  const Margins found = at(2.5);
  EXPECT_TRUE(found.searched);
  EXPECT_TRUE(found.open.empty());
  EXPECT_EQ(found.margins[0].worst_point, "t = 4");
  EXPECT_TRUE(found.violations.empty());
  const Margins failed = at(1.5);
  ASSERT_EQ(failed.violations.size(), 1U);
  EXPECT_EQ(failed.violations[0].point.label, "t = 4");
}

TEST_F(MarginsTest, WhatIsNotSettledBetweenThePointsIsOpen) {
  pose("{forall: \"t in [0, 1]\", that: \"x + cos(1e7*t) > 0\"}",
       "synthesis: {forall: exchange}\n");
  const Margins found = at(1.0001);
  EXPECT_TRUE(is_kept(found.margins[0]));
  EXPECT_EQ(found.open.rfind("all: not settled for t in [", 0), 0U) << found.open;
  pose("{forall: \"t in [0, 1]\", that: \"x + cos(70*t) > 0\"}", "synthesis: {forall: exchange}\n");
  EXPECT_TRUE(at(1.0001).open.empty());
}

}  // namespace
}  // namespace gainsmith::lmi
