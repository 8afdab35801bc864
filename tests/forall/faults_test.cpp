#include "forall/faults.h"

#include <gtest/gtest.h>

#include <string>

#include "forall/variables.h"

namespace gainsmith::forall {
namespace {

using testing::interval;
using testing::number;

const Domain kBox = {interval("a", -1, 1), interval("b", 0.1, 2)};

std::optional<Fault> fault_of(const std::string& text, const numbers::Values& known = {}) {
  return find_fault(testing::program(text, kBox, known), kBox, known);
}

double value_of(const Fault& fault, const std::string& variable) {
  return fault.point.values.at(variable)(0, 0);
}

TEST(Faults, AZeroOfADivisorBetweenThePointsOfTheGrid) {
  for (const std::string text : {"1/(a - 0.3217)", "[1, a]./[2, a - 0.3217]", "inv(a - 0.3217)",
                                 "inv([b, 1; b*a, 0.3217])", "jacobian(b/(a - 0.3217), b)"}) {
    const auto fault = fault_of(text);
    ASSERT_TRUE(fault) << text;
    EXPECT_NEAR(value_of(*fault, "a"), 0.3217, 1e-9) << text;
    EXPECT_GT(fault->place.column, 0) << text;
  }
  const auto curved = fault_of("1/(a^2 + b^2 - 1.5)");
  ASSERT_TRUE(curved);
  const double a = value_of(*curved, "a"), b = value_of(*curved, "b");
  EXPECT_NEAR(a * a + b * b, 1.5, 1e-9);
}

TEST(Faults, AnArgumentThatAFunctionDoesNotTake) {
  const auto root = fault_of("2*sqrt(a) + b");
  ASSERT_TRUE(root);
  EXPECT_LT(value_of(*root, "a"), 0);
  EXPECT_NE(root->message.find("sqrt of -"), std::string::npos) << root->message;
  EXPECT_TRUE(fault_of("jacobian(log(a + b), b)"));
}

TEST(Faults, NoneWhereThereIsAValueOrNothingIsKnown) {
  for (const std::string text : {"1/b", "1/(a + 1.01)", "sqrt(b)*log(b)", "inv([b, a; -a, b])",
                                 "1/(floor(a) + 0.5)", "a + b"})
    EXPECT_FALSE(fault_of(text)) << text;
  const numbers::Values known = {{"p", number(2)}};
  const expr::Program program = testing::program("b/(p + a)", kBox, known);
  EXPECT_FALSE(find_fault(program, kBox, known));
  EXPECT_FALSE(find_fault(program, kBox, {}));
  EXPECT_TRUE(find_fault(program, kBox, {{"p", number(0.5)}}));
  EXPECT_FALSE(find_fault(testing::program("1/p", {}, known), {}, known));
}

}  // namespace
}  // namespace gainsmith::forall
