#include "lmi/assembler.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/double_double.h"

namespace gainsmith::lmi {
namespace {

using numbers::Matrix;

/// B(x) = [1, 2, 0; 2, 3, 0; 0, 0, 4] + x_2 [0, 5, 0; 5, 6, 7; 0, 7, 0].
Block example() {
  Block block;
  block.name = "a";
  block.size = 3;
  Matrix constant(3, 3), slope(3, 3);
  constant << 1, 2, 0, 2, 3, 0, 0, 0, 4;
  slope << 0, 5, 0, 5, 6, 7, 0, 7, 0;
  block.terms = {{0, sparse(constant)}, {2, sparse(slope)}};
  return block;
}

/// Rows in 2, 1/4 and 8, unknowns in 1 and 1/2.
Balance units() { return {{{1, -2, 3}}, {0, -1}}; }

/// The element (row, column) of F_i in a block.
double element(const sdp::Problem& problem, int i, int block, int row, int column) {
  for (const sdp::Entry& entry : problem.f[static_cast<std::size_t>(i)])
    if (entry.block == block && entry.row == row && entry.column == column) return entry.value;
  return 0;
}

TEST(AssemblerTest, ABlockIsTakenInItsUnitsAndWithItsRows) {
  const Block block = example();
  const std::vector<double> x = {9, 10};
  const Matrix S = (numbers::Vector(3) << 2, 0.25, 8).finished().asDiagonal();
  const Matrix all = S * block.value(x) * S;
  // y = x / d; every number is exact.
  EXPECT_EQ(value_of(balanced(block, units(), 0, all_rows(block)), {9, 20}, 1), all);
  const BalancedBlock part = balanced(block, units(), 0, {1, 2});
  EXPECT_EQ(part.size, 2);
  EXPECT_EQ(value_of(part, {9, 20}, 1), all.bottomRightCorner(2, 2));
  // With 3 in place of 1: three times the constant part.
  EXPECT_EQ(value_of(part, {0, 0}, 3), 3 * (S * block.value({0, 0}) * S).bottomRightCorner(2, 2));
}

TEST(AssemblerTest, ConstantsStandOnTheOtherSideOrAtTheirVariable) {
  const BalancedBlock block = balanced(example(), {{{0, 0, 0}}, {0, 0}}, 0, {0, 1, 2});
  Assembler assembler(3);
  const int plain = assembler.add(block, 0, 1);
  const int homogenised = assembler.add(block, 3, 0.5);
  assembler.set_cost(3, -7);
  const sdp::Problem problem = assembler.take();
  EXPECT_EQ(problem.c, (std::vector<double>{0, 0, -7}));
  EXPECT_EQ(problem.blocks, (std::vector<sdp::Block>{{3, false}, {3, false}}));
  // X = sum x_i F_i - F_0.
  EXPECT_EQ(element(problem, 0, plain, 0, 1), -2);
  EXPECT_EQ(element(problem, 2, plain, 1, 1), 6);
  EXPECT_EQ(element(problem, 0, homogenised, 0, 1), 0);
  EXPECT_EQ(element(problem, 3, homogenised, 0, 1), 2);
  EXPECT_EQ(element(problem, 3, homogenised, 1, 1), 1.5);
  EXPECT_EQ(element(problem, 2, homogenised, 1, 1), 3);
  EXPECT_EQ(element(problem, 2, homogenised, 1, 2), 7);
  EXPECT_TRUE(problem.f[1].empty());
  sdp::validate(problem);
}

TEST(AssemblerTest, EntriesOfOnePlaceAreAddedWithTheirRests) {
  Assembler assembler(1);
  const int block = assembler.add_block(2);
  assembler.add_entry(1, block, 0, 1, 1, 1e-20);
  assembler.add_entry(1, block, 0, 0, 4);
  assembler.add_entry(1, block, 0, 1, 1e-17, 1e-34);
  assembler.add_entry(1, block, 1, 1, 2);
  assembler.add_entry(1, block, 1, 1, -2);
  assembler.add_entry(1, block, 1, 1, 0);
  const sdp::Problem problem = assembler.take();
  ASSERT_EQ(problem.f[1].size(), 2U);
  const sdp::Entry& sum = problem.f[1][1];
  EXPECT_EQ(problem.f[1][0].value, 4);
  EXPECT_EQ(std::pair(sum.row, sum.column), std::pair(0, 1));
  const DoubleDouble error = DoubleDouble(sum.value, sum.rest) - DoubleDouble(1) -
                             DoubleDouble(1e-17) - DoubleDouble(1e-20) - DoubleDouble(1e-34);
  EXPECT_LT(std::abs(error.hi()), 1e-31);
}

}  // namespace
}  // namespace gainsmith::lmi
