// Bounds of programs over boxes: they hold at all points, and say when there are none.
#include "numbers/graph/range.h"

#include <gtest/gtest.h>

#include <random>

#include "expr/binding/compile.h"
#include "expr/text/parser.h"
#include "numbers/graph/stacked_functions.h"

namespace gainsmith::numbers {
namespace {

/// A text over x of three elements.
class RangeOf {
 public:
  explicit RangeOf(const std::string& text) {
    expr::Scope scope;
    scope.symbols["x"] = {{3, 1}, false};
    program_ = expr::compile(expr::parse({text, "test"}), scope);
  }

  StackedFunctions function() const {
    return {{&program_}, [](const std::string&) { return 0; }, constants_, 3};
  }

 private:
  Values constants_;
  expr::Program program_;
};

TEST(Range, ValuesOfAllPointsLieInIt) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(0, 1);
  for (const char* text :
       {"x(1)*x(2) - x(3)", "x(1)^2 + x(2)^3 - x(3)^4", "x(1)/(2.5 + x(2)) + x(3)",
        "sin(3*x(1))*cos(7*x(2)) + sin(x(3))", "exp(x(1)) - tanh(x(2)) + abs(x(3))",
        "where(x(1) > 0.2, x(2), x(3)^2)", "max(x(1), min(x(2), x(3)))", "norm(x)",
        "sqrt(x'*x + 1)*sign(x(1))", "log(3 + x(1))*floor(2*x(2))",
        "clip(x(1) - x(1)^3, -0.1, 0.2)", "abs(x(1) - 2*x(2))^1.5"}) {
    const RangeOf of(text);
    StackedFunctions function = of.function();
    for (int trial = 0; trial < 200; ++trial) {
      const double width = std::pow(10, -4 * share(random));
      Box box(3);
      for (Range& one : box) {
        one.low = 4 * share(random) - 2;
        one.high = one.low + width;
      }
      if (!function.enclose(box)) {
        EXPECT_EQ(text, std::string("abs(x(1) - 2*x(2))^1.5")) << "no bounds";
        continue;
      }
      const Range range = function.range(0, 0);
      for (int point = 0; point < 20; ++point) {
        Vector x(3);
        for (int k = 0; k < 3; ++k) {
          const Range& one = box[static_cast<std::size_t>(k)];
          const double part = point < 8 ? (point >> k) & 1 : share(random);
          x(k) = one.low + part * (one.high - one.low);
        }
        const double value = function(x)(0);
        EXPECT_LE(range.low, value) << text;
        EXPECT_GE(range.high, value) << text;
      }
    }
  }
}

TEST(Range, ExtremaOfWavesInsideAreSeen) {
  const RangeOf of("sin(x(1)) + 0*x(2)");
  StackedFunctions function = of.function();
  ASSERT_TRUE(function.enclose({{1.5, 1.65}, {0, 0}, {0, 0}}));
  EXPECT_EQ(function.range(0, 0).high, 1);
  EXPECT_GT(function.range(0, 0).low, 0.99);
  ASSERT_TRUE(function.enclose({{-100, 100}, {0, 0}, {0, 0}}));
  EXPECT_EQ(function.range(0, 0).low, -1);
}

TEST(Range, IsNarrowWhereTheBoxIs) {
  const RangeOf of("x(1)^3 - x(1)*x(2) + norm(x)");
  StackedFunctions function = of.function();
  Box box(3, {0.7, 0.7});
  ASSERT_TRUE(function.enclose(box));
  EXPECT_LT(function.range(0, 0).high - function.range(0, 0).low, 1e-14);
}

TEST(Range, WholeNumbersAreAddedAndMultipliedExactly) {
  const auto is = [](ScalarOp op, double a, double b, double low, double high) {
    Range made;
    EXPECT_TRUE(enclose(op, {a, a}, {b, b}, {}, false, made));
    EXPECT_EQ(made.low, low);
    EXPECT_EQ(made.high, high);
  };
  is(ScalarOp::add, 3, -7, -4, -4);
  is(ScalarOp::subtract, 3, -7, 10, 10);
  is(ScalarOp::multiply, 3, -7, -21, -21);
  Range made;
  enclose(ScalarOp::multiply, {0x1p40, 0x1p40}, {0x1p40 + 1, 0x1p40 + 1}, {}, false, made);
  EXPECT_LT(made.low, made.high);
  enclose(ScalarOp::add, {0.5, 0.5}, {1, 1}, {}, false, made);
  EXPECT_LT(made.low, made.high);
}

TEST(Range, WhereSomethingMayHaveNoValueThereAreNone) {
  const Box around(3, {-1, 1});
  for (const char* text :
       {"1/x(1)", "log(x(2))", "sqrt(x(3))", "exp(1e4*x(1))", "inv(eye(3) + x*x')(1, 1)"}) {
    const RangeOf of(text);
    EXPECT_FALSE(of.function().enclose(around)) << text;
  }
}

}  // namespace
}  // namespace gainsmith::numbers
