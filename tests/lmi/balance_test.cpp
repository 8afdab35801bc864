#include "lmi/balance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "lmi/free_rows.h"
#include "numbers/matrix.h"

namespace gainsmith::lmi {
namespace {

using numbers::Matrix;

struct Blocks {
  std::vector<Block> list;
  int unknowns = 0;
  std::vector<double> objective;

  std::vector<const Block*> pointers() const {
    std::vector<const Block*> result;
    for (const Block& block : list) result.push_back(&block);
    return result;
  }
  Balance balance() const { return lmi::balance(pointers(), unknowns, objective); }

  /// All coefficients in the units of the balance.
  std::vector<Matrix> balanced() const {
    const Balance units = balance();
    std::vector<Matrix> result;
    for (std::size_t k = 0; k < list.size(); ++k)
      for (const auto& [i, sparse] : list[k].terms) {
        Matrix matrix = sparse.toDense();
        for (int r = 0; r < list[k].size; ++r)
          for (int c = 0; c < list[k].size; ++c) matrix(r, c) *= units.factor(k, r, c, i);
        result.push_back(std::move(matrix));
      }
    return result;
  }

  /// Of the objective, up to its own unit.
  std::vector<double> balanced_objective() const {
    const Balance units = balance();
    std::vector<double> result;
    double first = 0;
    for (std::size_t i = 0; i < objective.size(); ++i) {
      const double value = objective[i] * units.unit(static_cast<int>(i) + 1);
      if (first == 0) first = value;
      result.push_back(first == 0 ? 0 : value / first);
    }
    return result;
  }
};

Block block_with(const std::string& name, const std::vector<std::pair<int, Matrix>>& terms) {
  Block block;
  block.name = name;
  block.size = static_cast<int>(terms.front().second.rows());
  for (const auto& [i, matrix] : terms) block.terms.emplace_back(i, matrix.sparseView());
  return block;
}

/// A sparse symmetric matrix of numbers, or of small whole numbers.
Matrix random_matrix(int n, double density, bool whole, std::mt19937& generator) {
  std::uniform_real_distribution<double> chance;
  std::normal_distribution<double> number;
  Matrix matrix = Matrix::Zero(n, n);
  for (int r = 0; r < n; ++r)
    for (int c = r; c < n; ++c)
      if (chance(generator) < density)
        matrix(r, c) = matrix(c, r) =
            whole ? std::round(3 * number(generator)) : std::exp(2 * number(generator));
  return matrix;
}

Blocks random_blocks(bool whole, std::mt19937& generator) {
  std::uniform_real_distribution<double> chance;
  std::normal_distribution<double> number;
  Blocks blocks;
  blocks.unknowns = 1 + static_cast<int>(5 * chance(generator));
  const int count = 1 + static_cast<int>(4 * chance(generator));
  for (int k = 0; k < count; ++k) {
    // The second and third are one inequality at two points when they have the same size.
    const int n = k == 2 ? blocks.list[1].size : 1 + static_cast<int>(4 * chance(generator));
    std::vector<std::pair<int, Matrix>> terms;
    for (int i = chance(generator) < 0.5 ? 0 : 1; i <= blocks.unknowns; ++i)
      terms.emplace_back(i, random_matrix(n, 0.5, whole, generator));
    blocks.list.push_back(block_with(k == 2 ? "block 1" : "block " + std::to_string(k), terms));
  }
  if (chance(generator) < 0.5)
    for (int i = 0; i < blocks.unknowns; ++i)
      blocks.objective.push_back(whole ? std::round(2 * number(generator)) : number(generator));
  return blocks;
}

/// In other units: 2^e of rows and unknowns.
Blocks in_other_units(const Blocks& blocks, std::mt19937& generator) {
  std::uniform_int_distribution<int> exponent(-30, 30);
  std::vector<int> of_unknown = {0};
  for (int i = 0; i < blocks.unknowns; ++i) of_unknown.push_back(exponent(generator));
  Blocks result = blocks;
  std::map<std::string, std::vector<int>> of_rows;
  for (Block& block : result.list) {
    std::vector<int>& rows = of_rows[block.name];
    while (rows.size() < static_cast<std::size_t>(block.size)) rows.push_back(exponent(generator));
    for (auto& [i, matrix] : block.terms)
      for (int k = 0; k < matrix.outerSize(); ++k)
        for (Sparse::InnerIterator it(matrix, k); it; ++it)
          it.valueRef() = std::ldexp(it.value(), rows[static_cast<std::size_t>(it.row())] +
                                                     rows[static_cast<std::size_t>(it.col())] +
                                                     of_unknown[static_cast<std::size_t>(i)]);
  }
  const int common = exponent(generator);
  for (std::size_t i = 0; i < result.objective.size(); ++i)
    result.objective[i] = std::ldexp(result.objective[i], of_unknown[i + 1] + common);
  return result;
}

/// The search that ends early finds the rows that all equations leave.
TEST(BalanceTest, FewEquationsLeaveTheRowsThatAllLeave) {
  std::mt19937 generator(11);
  int several = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const Blocks blocks = random_blocks(false, generator);
    const BalanceElements elements(blocks.pointers(), blocks.unknowns, blocks.objective);
    const std::vector<int> rows = free_rows(elements);
    EXPECT_EQ(rows, free_rows_of_all(elements));
    several += rows.size() > 1 && std::ssize(rows) < elements.rows();
  }
  EXPECT_GT(several, 50);
}

/// Whole numbers have their exact halves of exponents.
TEST(BalanceTest, UnitsThatArePowersOfTwoGiveTheSameBits) {
  std::mt19937 generator(11);
  for (int trial = 0; trial < 400; ++trial) {
    const Blocks blocks = random_blocks(trial % 2 == 0, generator);
    const std::vector<Matrix> expected = blocks.balanced();
    for (int again = 0; again < 3; ++again) {
      const Blocks other = in_other_units(blocks, generator);
      EXPECT_EQ(other.balanced(), expected) << "trial " << trial;
      EXPECT_EQ(other.balanced_objective(), blocks.balanced_objective()) << "trial " << trial;
    }
  }
}

/// P > 0, He(P A - Y C) < 0 of a double integrator: what moves P's rows by one moves the other
/// block's by a half.
TEST(BalanceTest, ADoubleIntegratorHasTheSameBitsInAllUnits) {
  std::mt19937 generator(12);
  const auto unit = [](int r, int c) {
    Matrix matrix = Matrix::Zero(2, 2);
    matrix(r, c) = matrix(c, r) = 1;
    return matrix;
  };
  Blocks blocks;
  blocks.unknowns = 5;
  blocks.list = {
      block_with("positive", {{1, unit(0, 0)}, {2, unit(0, 1)}, {3, unit(1, 1)}}),
      block_with(
          "flow",
          {{1, -3 * unit(0, 1)}, {2, -6 * unit(1, 1)}, {4, 2 * unit(0, 0)}, {5, unit(0, 1)}}),
  };
  const std::vector<Matrix> expected = blocks.balanced();
  for (int trial = 0; trial < 50; ++trial)
    EXPECT_EQ(in_other_units(blocks, generator).balanced(), expected) << trial;
}

/// Coefficients between 1/2 and 2 in some units, whatever those are, are near 1 again.
TEST(BalanceTest, BadUnitsAreFound) {
  std::mt19937 generator(13);
  std::uniform_real_distribution<double> exponent(-1, 1);
  for (int trial = 0; trial < 50; ++trial) {
    Blocks blocks;
    blocks.unknowns = 3;
    std::vector<double> units;
    for (int i = 0; i <= 3; ++i) units.push_back(i == 0 ? 1 : std::exp2(30 * exponent(generator)));
    for (int k = 0; k < 2; ++k) {
      const int n = 3 + k;
      const numbers::Vector rows =
          numbers::Vector::NullaryExpr(n, [&] { return std::exp2(20 * exponent(generator)); });
      std::vector<std::pair<int, Matrix>> terms;
      for (int i = 0; i <= 3; ++i) {
        Matrix matrix(n, n);
        for (int r = 0; r < n; ++r)
          for (int c = r; c < n; ++c)
            matrix(r, c) = matrix(c, r) =
                units[static_cast<std::size_t>(i)] * std::exp2(exponent(generator));
        terms.emplace_back(i, rows.asDiagonal() * matrix * rows.asDiagonal());
      }
      blocks.list.push_back(block_with(std::to_string(k), terms));
    }
    for (const Matrix& matrix : blocks.balanced()) {
      EXPECT_LT(matrix.cwiseAbs().maxCoeff(), 16) << trial;
      EXPECT_GT(matrix.cwiseAbs().minCoeff(), 1. / 16) << trial;
    }
  }
}

TEST(BalanceTest, NoiseDoesNotCount) {
  std::mt19937 generator(14);
  std::normal_distribution<double> number;
  for (int trial = 0; trial < 20; ++trial) {
    Blocks blocks;
    blocks.unknowns = 2;
    Matrix first = random_matrix(4, 1, false, generator);
    first(1, 2) = first(2, 1) = 0;
    const Matrix second = random_matrix(4, 1, false, generator);
    const auto with = [&](double noise) {
      Matrix noisy = first;
      noisy(1, 2) = noisy(2, 1) = noise;
      Blocks result = blocks;
      result.list = {block_with("a", {{0, second}, {1, noisy}, {2, second}})};
      return result.balance();
    };
    const Balance clean = with(0);
    const Balance noisy = with(1e-15 * number(generator));
    EXPECT_EQ(noisy.rows, clean.rows);
    EXPECT_EQ(noisy.unknowns, clean.unknowns);
  }
}

/// An element that stands alone in its row counts, however small it is.
TEST(BalanceTest, WhatStandsAloneCounts) {
  Blocks blocks;
  blocks.unknowns = 1;
  Matrix matrix = Matrix::Zero(2, 2);
  matrix(0, 0) = 1;
  matrix(1, 1) = 1e-20;
  blocks.list = {block_with("a", {{0, Matrix::Ones(1, 1)}}), block_with("b", {{1, matrix}})};
  const std::vector<Matrix> balanced = blocks.balanced();
  EXPECT_GT(balanced[1](1, 1), 0.25);
  EXPECT_LT(balanced[1](1, 1), 4);
}

/// An inequality that is imposed at many points has no more weight than one that is not.
TEST(BalanceTest, PointsOfOneInequalityShareTheirUnits) {
  Blocks blocks;
  blocks.unknowns = 1;
  const auto number = [](double value) { return Matrix::Constant(1, 1, value); };
  blocks.list = {block_with("once", {{1, number(1)}}), block_with("often", {{1, number(16)}})};
  const Balance once = blocks.balance();
  for (int k = 0; k < 9; ++k) blocks.list.push_back(blocks.list[1]);
  const Balance often = blocks.balance();
  EXPECT_EQ(often.unknowns, once.unknowns);
  for (std::size_t k = 0; k < blocks.list.size(); ++k)
    EXPECT_EQ(often.rows[k], once.rows[k == 0 ? 0 : 1]) << k;
}

}  // namespace
}  // namespace gainsmith::lmi
