#include "verdict/printed_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

#include "base/scalars.h"
#include "bind/instance.h"
#include "model/gains.h"
#include "support/yaml_problem.h"

namespace gainsmith::verdict {
namespace {

using Status = forall::DomainProof::Status;

/// "all: require" at one unknown number x.
forall::DomainProof checked(const std::string& require, double x, const std::string& more = "",
                            const Rational* solution = nullptr) {
  const tests::YamlProblem yaml(
      "problem: p\nmethod:\n  method: m\n  data: {a: {shape: scalar, default: 0.3}}\n  unknowns: "
      "{x: scalar}\n  require:\n    all: " +
      require + "\n" + more);
  const lmi::Inequalities of(yaml.instance);
  const std::vector<double> unknowns = {x};
  std::vector<Rational> exactly;
  if (solution != nullptr) exactly.push_back(*solution);
  return PrintedCheck(of, unknowns, forall::ProofOptions{}.most_pieces,
                      solution != nullptr ? &exactly : nullptr)
      .check(0, 0);
}

TEST(PrintedCheckTest, ADoubleStandsForTheDecimalThatIsPrinted) {
  const double sum = 0.1 + 0.2;
  const auto known = enclosed_decimal<DoubleDouble>(sum);
  EXPECT_EQ(model::printed(sum), "0.30000000000000004");
  EXPECT_EQ(model::printed(0.3), "0.3");
  const DoubleDouble error = known.mid(0, 0) - *parse_as<DoubleDouble>("0.30000000000000004");
  EXPECT_LE(std::abs(error.hi()), known.rad(0, 0));
  EXPECT_GT(std::abs((known.mid(0, 0) - DoubleDouble(sum)).hi()), 1e-19);
  EXPECT_EQ(enclosed_decimal<double>(0.375).rad(0, 0), 0);
  EXPECT_GT(enclosed_decimal<double>(0.3).rad(0, 0), 0);
}

/// Decimals that are the same double are not the same.
TEST(PrintedCheckTest, TheDecimalsOfTheFileCountAndNotTheirDoubles) {
  const double sum = 0.1 + 0.2;  // printed as 0.30000000000000004
  EXPECT_EQ(checked("x < 0.300000000000000044", sum).status, Status::holds);
  EXPECT_EQ(checked("x >= 0.300000000000000044", sum).status, Status::fails);
  EXPECT_EQ(checked("x > 0.30000000000000004", sum).status, Status::fails);
  EXPECT_EQ(checked("x >= 0.30000000000000004", sum).status, Status::holds);
  EXPECT_EQ(checked("x >= a", 0.3).status, Status::holds);
  EXPECT_EQ(checked("x > a", 0.3).status, Status::fails);
  EXPECT_EQ(checked("x > a", std::nextafter(0.3, 1)).status, Status::holds);
  EXPECT_EQ(checked("x >= 0.375", 0.375).status, Status::holds);
  EXPECT_EQ(checked("x > 0.375", 0.375).status, Status::fails);
}

/// 0.1 is below its double: the interval of the file ends before it.
TEST(PrintedCheckTest, AnIntervalEndsAtTheDecimalsOfTheFile) {
  const auto over = [](const std::string& variable, const std::string& holds) {
    return "{forall: [" + variable + "], that: \"" + holds + "\"}";
  };
  EXPECT_EQ(checked(over("\"t in [0, 0.1]\"", "x >= 10*t"), 1).status, Status::holds);
  EXPECT_NE(checked(over("\"t in [0, 0.1]\"", "x >= 10*t"), std::nextafter(1., 0)).status,
            Status::holds);
  EXPECT_NE(checked(over("\"t in [0, 0.1]\"", "x > 10*t"), 1).status, Status::holds);
  EXPECT_EQ(checked(over("\"t in [0, 0.1]\", \"s in [0.3, 0.7]\"", "x >= 10*t*s/0.7"), 1).status,
            Status::holds);
  EXPECT_EQ(
      checked(over("\"t in [0, 0.1]\", \"s in {0.3, 0.7}\"", "[x, 10*t; 10*t, s/0.7] >= 0"), 1)
          .status,
      Status::fails);
  // Not affine: the ends decide nothing.
  EXPECT_NE(checked(over("\"t in [-0.1, 0.1]\"", "x >= 1.01 - t^2"), 1).status, Status::holds);
}

TEST(PrintedCheckTest, MoreDigitsDecideWhereDoubleDoesNot) {
  // 1 - x^2 is 2e-16, or below 0.
  EXPECT_EQ(checked("\"[1, x; x, 1] > 0\"", std::nextafter(1., 0)).status, Status::holds);
  EXPECT_EQ(checked("\"[1, x; x, 1] > 0\"", std::nextafter(1., 2)).status, Status::fails);
  // In a plane that is nowhere an axis.
  EXPECT_EQ(checked("\"[2, 1, 3; 1, 5, 6; 3, 6, 9 + x] > 0\"", 1e-14).status, Status::holds);
  EXPECT_EQ(checked("\"[2, 1, 3; 1, 5, 6; 3, 6, 9 - x] > 0\"", 1e-14).status, Status::fails);
}

/// No number of digits shows that a singular matrix is not negative; fractions do.
TEST(PrintedCheckTest, WhatIsExactlySingularHoldsWhereItMay) {
  EXPECT_EQ(checked("\"[1, 3*x; *, 0.09] >= 0\"", 0.1).status, Status::holds);
  EXPECT_EQ(checked("\"[1, 3*x; *, 0.09] > 0\"", 0.1).status, Status::fails);
  EXPECT_EQ(checked("\"[1, 3*x; *, 0.09] >= 0\"", std::nextafter(0.1, 1)).status, Status::fails);
  EXPECT_EQ(checked("{forall: \"k in {0.1, 0.2}\", that: \"[k, x; *, k] >= 0\"}", 0.1).status,
            Status::holds);
  EXPECT_NE(checked("{forall: \"k in {0.1, 0.2}\", that: \"[k, x; *, k] >= 0\"}", 0.2).status,
            Status::holds);
  EXPECT_NE(checked("{forall: \"k in {0.1, 0.2}\", that: \"[k, x; *, k] > 0\"}", 0.1).status,
            Status::holds);
}

/// In fractions, and where the text has none in balls around them: 1/3 - 1e-40 is less than 1/3.
TEST(PrintedCheckTest, ASolutionInFractionsStandsForTheDecimalsNearIt) {
  const double near = 1. / 3;
  const Rational third(1, 3), less = third - power_of_ten(-40);
  EXPECT_EQ(checked("3*x == 1", near).status, Status::fails);
  EXPECT_EQ(checked("3*x == 1", near, "", &third).status, Status::holds);
  EXPECT_EQ(checked("3*x == 1", near, "", &less).status, Status::fails);
  EXPECT_EQ(checked("exp(1)*(1 - 3*x) > 0", near, "", &less).status, Status::holds);
  EXPECT_EQ(checked("exp(1)*(3*x - 1) > 0", near, "", &less).status, Status::fails);
  EXPECT_EQ(checked("exp(1)*(1 - 3*x) > 0", near, "", &third).status, Status::open);
}

/// sqrt(2)^2 is 2, which no number of digits shows.
TEST(PrintedCheckTest, WhatOnlyAlgebraKnowsIsOpen) {
  EXPECT_EQ(checked("sqrt(x)*sqrt(x) > 2", 2).status, Status::open);
  EXPECT_EQ(checked("sqrt(x)*sqrt(x) > 2", std::nextafter(2., 3)).status, Status::holds);
}

TEST(PrintedCheckTest, AnIntervalIsCheckedAsAWhole) {
  // The largest value of sin is 1, at t = pi/2, which no point of a grid meets.
  const std::string wave = "{forall: \"t in [0, 3]\", that: \"x > sin(t)\"}";
  EXPECT_EQ(checked(wave, 1 + 1e-9).status, Status::holds);
  const forall::DomainProof below = checked(wave, 1 - 1e-9);
  ASSERT_EQ(below.status, Status::fails);
  EXPECT_GT(std::sin(below.point->values.at("t")(0, 0)), 1 - 1e-9);
  EXPECT_NE(checked(wave, 1).status, Status::holds);
}

/// The end 0.3 is no double: what lies between it and its double belongs to the interval.
TEST(PrintedCheckTest, TheEndsAreThoseOfTheFile) {
  const std::string end = "{forall: \"t in [0, a]\", that: \"x > t\"}";
  EXPECT_EQ(checked(end, 0.3 + 2e-16).status, Status::holds);
  EXPECT_NE(checked(end, 0.3).status, Status::holds);
}

TEST(PrintedCheckTest, WhatHasNoValueIsNoYes) {
  EXPECT_NE(checked("{forall: \"t in [0, 1]\", that: \"x > 1/(t - a)\"}", 1e9).status,
            Status::holds);
  const forall::DomainProof none = checked("x > log(a - 1)", 1e9);
  EXPECT_EQ(none.status, Status::open);
  EXPECT_FALSE(none.reason.empty());
}

TEST(PrintedCheckTest, ASearchedScalarReplacesTheOneOfTheFile) {
  const tests::YamlProblem yaml(
      "problem: p\nmethod:\n  method: m\n  data: {a: scalar}\n  unknowns: {x: scalar}\n  require: "
      "{all: x > a}\ndata: {a: 1}\n");
  const std::vector<double> x = {2};
  for (const double a : {1.5, 2.0, 2.5}) {
    const lmi::Inequalities of(bind::evaluate(yaml.instance.design, {{"a", a}}));
    EXPECT_EQ(PrintedCheck(of, x).check(0, 0).status == Status::holds, a < 2) << a;
  }
}

}  // namespace
}  // namespace gainsmith::verdict
