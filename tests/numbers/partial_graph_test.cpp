#include "numbers/graph/partial_graph.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "base/double_double.h"
#include "expr/program/operations.h"

namespace gainsmith::numbers {
namespace {

/// The operation on numbers that has the name of an operation of the language.
ScalarOp scalar_op(expr::Op op) {
  switch (op) {
#define NUMBERS(op, ...) \
  case expr::Op::op:     \
    return ScalarOp::op;
#include "expr/operations.def"
    default:
      throw std::logic_error("no function of numbers");
  }
}

/// In 31 digits (f(x + h) - f(x - h))/(2 h) has an error of h^2 and of 1e-32/h.
TEST(PartialGraphs, AreTheDerivativesOfAllFunctionsOfTheTable) {
  using D = DoubleDouble;
  for (const expr::NumberFunction& function : expr::kNumberFunctions) {
    if (!expr::has_derivatives(function.op)) continue;
    for (const double x : {0.3, 0.9, 2.6}) {
      for (const double y : {0.7, 1.4}) {
        const std::size_t operands = function.derivatives[1].empty() ? 1 : 2;
        for (std::size_t k = 0; k < operands; ++k) {
          const D h(1e-9);
          const auto at = [&](const D& move) {
            return ScalarOperations<D>::apply(scalar_op(function.op), k == 0 ? D(x) + move : D(x),
                                              k == 1 ? D(y) + move : D(y), D(0));
          };
          const D slope = (at(h) - at(-h)) / (D(2) * h);
          const double error =
              static_cast<double>(value_of(partial_graph(function.op, k), D(x), D(y)) - slope);
          EXPECT_LT(std::abs(error), 1e-15 * (1 + std::abs(static_cast<double>(slope))))
              << expr::to_string(function.op) << " by operand " << k << " at " << x << ", " << y;
        }
      }
    }
  }
}

TEST(PartialGraphs, AreNoNumbersWhereThereIsNoDerivative) {
  const auto value = [](expr::Op op, std::size_t k, double a, double b) {
    return value_of(partial_graph(op, k), a, b);
  };
  EXPECT_FALSE(std::isfinite(value(expr::Op::sqrt, 0, 0, 0)));
  EXPECT_FALSE(std::isfinite(value(expr::Op::log, 0, -1, 0)));
  EXPECT_FALSE(std::isfinite(value(expr::Op::real_power, 1, -1, 2)));
  EXPECT_FALSE(std::isfinite(value(expr::Op::atan2, 0, 0, 0)));
  // x^0 is 1 everywhere.
  EXPECT_EQ(value(expr::Op::real_power, 0, 0, 0), 0);
}

}  // namespace
}  // namespace gainsmith::numbers
