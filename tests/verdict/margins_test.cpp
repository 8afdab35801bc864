#include "verdict/margins.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include "support/yaml_problem.h"

namespace gainsmith::verdict {
namespace {

/// One unknown number x in one inequality, "all".
class MarginsTest : public ::testing::Test {
 protected:
  MarginsTest() { pose("x > 1"); }

  void pose(const std::string& require, const std::string& more = "") {
    yaml_ = std::make_unique<tests::YamlProblem>(
        "problem: p\nmethod:\n  method: m\n  unknowns: {x: scalar}\n  require:\n    all: " +
        require + "\n" + more);
    of_ = std::make_unique<lmi::Inequalities>(yaml_->instance);
    plan_ = forall::make_plan(of_->design());
    lmi_ = compile(*of_, plan_);
  }

  Margins at(double x, double wished = 1e-9) const {
    std::vector<const lmi::Block*> blocks;
    for (const lmi::Block& block : lmi_.blocks) blocks.push_back(&block);
    return compute_margins(*of_, lmi_, balance(blocks, lmi_.unknowns, {}), wished, {x});
  }

  std::unique_ptr<tests::YamlProblem> yaml_;
  std::unique_ptr<lmi::Inequalities> of_;
  forall::Plan plan_;
  lmi::Lmi lmi_;
};

/// [x, 1; 1, 1] has the correlation 1/sqrt(x).
TEST_F(MarginsTest, AreTheSmallestEigenvalueMeasuredByTheDiagonal) {
  pose("\"[x, 1; 1, 1] > 0\"");
  const Margins found = at(4);
  ASSERT_EQ(found.margins.size(), 1U);
  EXPECT_NEAR(found.margins[0].reached, 0.5, 1e-15);
  EXPECT_NEAR(found.margins[0].smallest_eigenvalue, 2.5 - std::sqrt(3.25), 1e-15);
  EXPECT_EQ(found.margins[0].required, 1e-9);
  EXPECT_TRUE(all_hold(found));
  EXPECT_TRUE(found.open.empty());
  EXPECT_TRUE(all_hold(at(4, 0.6)));  // less than was wished for
  EXPECT_FALSE(all_hold(at(0.5)));
  EXPECT_LT(at(0.5).margins[0].reached, 0);
}

TEST_F(MarginsTest, DoNotDependOnUnits) {
  pose("\"[x, 1; 1, 1] > 0\"");
  const double reached = at(3).margins[0].reached;
  pose("\"[1e-30*x, 1e-3; 1e-3, 1e24] > 0\"");
  EXPECT_NEAR(at(3).margins[0].reached, reached, 1e-14);
  EXPECT_TRUE(all_hold(at(3)));
}

/// What doubles cannot tell apart is decided at the decimals.
TEST_F(MarginsTest, AYesIsDecidedAtTheDecimals) {
  pose("\"[x, 0.1; 0.1, 0.1] > 0\"");  // x > 0.1
  EXPECT_FALSE(all_hold(at(0.1)));
  EXPECT_TRUE(all_hold(at(std::nextafter(0.1, 1))));
  EXPECT_FALSE(all_hold(at(std::nextafter(0.1, 0))));
  pose("\"[x, 0.1; 0.1, 0.1] >= 0\"");
  EXPECT_TRUE(all_hold(at(0.1)));
  EXPECT_FALSE(all_hold(at(std::nextafter(0.1, 0))));
}

TEST_F(MarginsTest, AScalarHasTheMarginOne) {
  for (const double x : {1 + 1e-15, 1.5, 1e300}) {
    EXPECT_EQ(at(x).margins[0].reached, 1) << x;
  }
  EXPECT_FALSE(all_hold(at(1)));
}

/// The text counts whatever the blocks say, and the blocks whatever the text says.
TEST_F(MarginsTest, AMistakeInTheBlocksShowsUp) {
  ASSERT_EQ(lmi_.blocks[0].terms[0].first, 0);
  lmi_.blocks[0].terms[0].second *= -1;  // x + 1 > 0
  EXPECT_DOUBLE_EQ(at(0.5).margins[0].smallest_eigenvalue, -0.5);
  EXPECT_FALSE(all_hold(at(0.5)));
  lmi_.blocks[0].terms[0].second *= -3;  // x - 3 > 0
  EXPECT_DOUBLE_EQ(at(2).margins[0].smallest_eigenvalue, -1);
  EXPECT_FALSE(all_hold(at(2)));
}

TEST_F(MarginsTest, WhatIsNoNumberDoesNotHold) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const char* require : {"x > 1", "{forall: \"k in {1, 2}\", that: \"[x, 1; 1, k] > 0\"}"}) {
    pose(require);
    try {
      EXPECT_FALSE(all_hold(at(nan))) << require;
    } catch (const InputError&) {
      // Refused by the arithmetic: that is no yes either.
    }
  }
}

TEST_F(MarginsTest, TheWorstPointIsOnTheWholeInterval) {
  pose("{forall: \"t in [0.1, 4]\", that: \"[x, sqrt(t); *, 1] > 0\"}",
       "synthesis: {forall: exchange}\n");
  const Margins found = at(6);
  EXPECT_TRUE(all_hold(found));
  EXPECT_EQ(found.margins[0].worst_point, "t = 4");
  EXPECT_NEAR(found.margins[0].reached, 1 - std::sqrt(4. / 6), 1e-12);
  EXPECT_TRUE(found.violations.empty());
  const Margins failed = at(3);
  EXPECT_FALSE(all_hold(failed));
  ASSERT_EQ(failed.violations.size(), 1U);
  EXPECT_EQ(failed.violations[0].point.label, "t = 4");
}

TEST_F(MarginsTest, WhatIsNotSettledBetweenThePointsIsOpen) {
  pose("{forall: \"t in [0, 1]\", that: \"x + cos(1e7*t) > 0\"}",
       "synthesis: {forall: exchange}\n");
  const Margins found = at(1.0001);
  EXPECT_FALSE(all_hold(found));
  EXPECT_EQ(found.open.rfind("all: not settled for t in [", 0), 0U) << found.open;
  pose("{forall: \"t in [0, 1]\", that: \"x + cos(70*t) > 0\"}", "synthesis: {forall: exchange}\n");
  EXPECT_TRUE(all_hold(at(1.0001)));
  EXPECT_TRUE(at(1.0001).open.empty());
}

}  // namespace
}  // namespace gainsmith::verdict
