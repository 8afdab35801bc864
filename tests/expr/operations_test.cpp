// The table of operations: shapes that do not fit are refused where a program is made.
#include "expr/program/operations.h"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>
#include <vector>

#include "expr/binding/functions.h"
#include "expr/program/assembly.h"
#include "expr/program/number_type.h"
#include "expr/world.h"

namespace gainsmith::expr {
namespace {

using Shapes = std::vector<Shape>;

TEST(Operations, StandInTheOrderOfTheirEnumeration) {
  for (const Operation& row : operations()) {
    EXPECT_EQ(&operation(row.op), &row) << row.identifier;
    EXPECT_FALSE(row.name.empty()) << row.identifier;
  }
}

TEST(Operations, AFunctionOfOneOperationIsCalledAsMessagesCallIt) {
  for (const Function& function : functions())
    if (const Op* op = std::get_if<Op>(&function.what)) {
      EXPECT_EQ(function.name, to_string(*op));
      EXPECT_EQ(function.fewest, operation(*op).operands);
    }
}

TEST(Operations, ShapesFollowFromTheOperands) {
  EXPECT_EQ(result_shape(Op::multiply, Shapes{{2, 3}, {3, 4}}), (Shape{2, 4}));
  EXPECT_EQ(result_shape(Op::transpose, Shapes{{2, 3}}), (Shape{3, 2}));
  EXPECT_EQ(result_shape(Op::blocks, Shapes{{1, 2}, {1, 3}, {4, 2}, {4, 3}}, {2}), (Shape{5, 5}));
  EXPECT_EQ(result_shape(Op::index, Shapes{{4, 5}}, {1, 3, 0, 5}), (Shape{2, 5}));
  EXPECT_EQ(result_shape(Op::singular_values, Shapes{{2, 3}}), (Shape{2, 1}));
  EXPECT_EQ(result_shape(Op::trace, Shapes{{3, 3}}), Shape{});
  EXPECT_EQ(result_shape(Op::fill, Shapes{{}}, {}, {2, 3}), (Shape{2, 3}));
}

TEST(Operations, OperandsThatDoNotFitGiveNoShape) {
  EXPECT_FALSE(result_shape(Op::multiply, Shapes{{2, 3}, {2, 3}}));
  EXPECT_FALSE(result_shape(Op::add, Shapes{{2, 3}, {3, 2}}));
  EXPECT_FALSE(result_shape(Op::add, Shapes{{2, 3}}));
  EXPECT_FALSE(result_shape(Op::scale, Shapes{{2, 3}, {2, 3}}));
  EXPECT_FALSE(result_shape(Op::divide, Shapes{{2, 3}, {2, 3}}));
  EXPECT_FALSE(result_shape(Op::inverse, Shapes{{2, 3}}));
  EXPECT_FALSE(result_shape(Op::blocks, Shapes{{1, 2}, {2, 2}}, {2}));
  EXPECT_FALSE(result_shape(Op::blocks, Shapes{{1, 2}, {1, 2}, {1, 2}}, {2}));
  EXPECT_FALSE(result_shape(Op::index, Shapes{{4, 5}}, {1, 5, 0, 5}));
  EXPECT_FALSE(result_shape(Op::diagonal_matrix, Shapes{{2, 2}}));
  EXPECT_FALSE(result_shape(Op::identity, Shapes{{}}, {}, {2, 3}));
  EXPECT_FALSE(result_shape(Op::kernel_basis, Shapes{{2, 5}}, {}, {5, 2}));
}

TEST(Operations, AWrongShapeIsAFaultOfTheProgram) {
  Assembly assembly;
  const int a = assembly.add_input("a", {2, 3}, {});
  const Instruction sum{Op::add, {a, a}, {3, 2}, {}, {}, {}, 0};
  EXPECT_THROW(assembly.add(sum), std::logic_error);
}

/// A number type that forgets everything but sums.
struct SumsOnly {
  void operator()(Is<Op::add>, const Step<double>& at, double& out) const { out = at[0] + at[1]; }
};

TEST(NumberTypes, WhatIsForgottenIsKnownWhenCompiled) {
  static_assert(Computes<SumsOnly, double, Op::add>);
  static_assert(!Computes<SumsOnly, double, Op::subtract>);
}

}  // namespace
}  // namespace gainsmith::expr
