#include "expr/binding/condition.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "numbers/types/real.h"
#include "support/input_error.h"

namespace gainsmith::expr {
namespace {

using Kind = Condition::Kind;
using numbers::Matrix;

Scope scope() {
  Scope result;
  result.symbols["x"] = {{2, 1}};
  result.symbols["q"] = {};
  result.symbols["A"] = {{2, 2}};
  return result;
}

Condition condition(const std::string& text) {
  return compile_condition(parse({text, "test"}), scope());
}

bool holds(const Condition& one, const numbers::Values& values) {
  const auto part_holds = [&](const Condition& part) { return holds(part, values); };
  if (one.is_comparison()) {
    const Matrix difference = numbers::evaluate(one.difference, values);
    if (one.kind == Kind::positive) return (difference.array() > 0).all();
    if (one.kind == Kind::nonnegative) return (difference.array() >= 0).all();
    return (difference.array() == 0).all();
  }
  if (one.kind == Kind::all) return std::all_of(one.parts.begin(), one.parts.end(), part_holds);
  if (one.kind == Kind::any) return std::any_of(one.parts.begin(), one.parts.end(), part_holds);
  return !part_holds(one.parts.front());
}

TEST(Condition, MeansWhatItSays) {
  struct Case {
    std::string text;
    double a, b, q;
    bool expected;
  };
  const std::vector<Case> cases = {
      {"x(1) <= 0 and x(2) < 0", 0, -1, 0, true},
      {"x(1) <= 0 and x(2) < 0", 0, 0, 0, false},
      {"x(1) > 1 or q == 1", 0, 0, 1, true},
      {"not (x(1) > 1 or q == 1)", 0, 0, 1, false},
      {"0 < x(1) <= 1", 1, 0, 0, true},
      {"0 < x(1) <= 1", 0, 0, 0, false},
      {"q != 1", 0, 0, 1, false},
      {"q != 1", 0, 0, 2, true},
      {"abs(x) <= 8", 8, -8, 0, true},
      {"x >= 1", 1, 0, 0, false},
      {"max(abs(x)) >= 11", -11, 3, 0, true},
  };
  for (const Case& one : cases) {
    const numbers::Values values = {{"x", Matrix{{one.a}, {one.b}}}, {"q", Matrix{{one.q}}}};
    EXPECT_EQ(holds(condition(one.text), values), one.expected) << one.text;
  }
}

TEST(Condition, MistakesStandAtTheirPlace) {
  using tests::input_error;
  EXPECT_EQ(input_error([] { condition("x(1)"); }).what(),
            std::string("test:1:1: expected a condition such as x(1) <= 0, found 'x(1)'"));
  EXPECT_NE(input_error([] { condition("q > 0 and x < A"); }).message().find("cannot compare"),
            std::string::npos);
  EXPECT_EQ(input_error([] { condition("q > 0 and 2"); }).place().column, 11);
}

}  // namespace
}  // namespace gainsmith::expr
