// Whole solutions of linear equations, checked in fractions.
#include "numerics/lattice.h"

#include <gtest/gtest.h>

#include <random>

#include "numbers/dense/rational_algebra.h"

namespace gainsmith::numerics {
namespace {

class Draws {
 public:
  explicit Draws(unsigned seed) : generator_(seed) {}

  int between(int low, int high) {
    return std::uniform_int_distribution<int>(low, high)(generator_);
  }
  RationalMatrix matrix(Eigen::Index rows, Eigen::Index cols, int size = 9) {
    RationalMatrix M(rows, cols);
    for (Eigen::Index i = 0; i < M.size(); ++i) M(i) = Rational(between(-size, size));
    return M;
  }

 private:
  std::mt19937 generator_;
};

TEST(LatticeTest, FindsWholeSolutionsNearAPoint) {
  Draws draws(3);
  for (int k = 0; k < 40; ++k) {
    const int n = draws.between(2, 7);
    const int p = draws.between(1, n - 1);
    RationalMatrix A = draws.matrix(p, n);
    if (std::ssize(numbers::reduced_echelon(A).pivots) < p) continue;
    RationalMatrix planted(n, 1);
    for (int i = 0; i < n; ++i) planted(i) = Rational(draws.between(-1000000, 1000000));
    std::vector<Rational> near;
    for (int i = 0; i < n; ++i) near.push_back(planted(i) + Rational(1, 3));
    const auto X = whole_solution(A, A * planted, near);
    ASSERT_TRUE(X);
    RationalMatrix found(n, 1);
    for (int i = 0; i < n; ++i) found(i) = Rational((*X)[static_cast<std::size_t>(i)]);
    EXPECT_EQ(A * found, A * planted);
    for (int i = 0; i < n; ++i) {
      // A kernel of such equations has vectors of a few hundred at most.
      EXPECT_LE(abs(Rational(found(i) - planted(i))), Rational(10000));
    }
  }
}

/// P B = C for a symmetric P of n rows, the elements of its upper triangle as unknowns: each of
/// them stands in up to two equations of each column of B.
TEST(LatticeTest, FindsWholeSolutionsOfLargeSparseEquations) {
  for (const int columns : {1, 2}) {
    Draws draws(7);
    const int n = 14;
    const int unknowns = n * (n + 1) / 2;
    const RationalMatrix B = draws.matrix(n, columns, 999);
    const auto place = [&](int i, int j) {
      return std::min(i, j) * n - std::min(i, j) * (std::min(i, j) - 1) / 2 + std::abs(i - j);
    };
    RationalMatrix A = RationalMatrix::Constant(n * columns, unknowns, Rational(0));
    for (int c = 0; c < columns; ++c)
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) A(c * n + i, place(i, j)) += B(j, c);
    const RationalMatrix planted = draws.matrix(unknowns, 1, 100000000);
    const RationalMatrix b = A.lazyProduct(planted);
    std::vector<Rational> near;
    for (const Rational& x : planted.reshaped()) near.push_back(x + Rational(1, 3));
    const auto X = whole_solution(A, b, near);
    ASSERT_TRUE(X);
    RationalMatrix found(unknowns, 1);
    for (int i = 0; i < unknowns; ++i) found(i) = Rational((*X)[static_cast<std::size_t>(i)]);
    EXPECT_EQ(A.lazyProduct(found), b);
    const RationalMatrix moved = found - planted;
    for (const Rational& x : moved.reshaped()) EXPECT_LE(abs(x), Rational(10000));
  }
}

TEST(LatticeTest, SaysWhereThereAreNone) {
  RationalMatrix A(1, 2);
  A << 2, 4;
  RationalMatrix b = RationalMatrix::Constant(1, 1, Rational(3));
  EXPECT_FALSE(whole_solution(A, b, {0, 0}));
  A << 2, 3;
  EXPECT_TRUE(whole_solution(A, b, {0, 0}));
  RationalMatrix both(2, 2);
  both << 1, 1, 1, -1;
  RationalMatrix odd(2, 1);
  odd << 1, 0;
  EXPECT_FALSE(whole_solution(both, odd, {0, 0}));
  RationalMatrix twice(2, 2);
  twice << 2, 3, 4, 6;
  RationalMatrix apart(2, 1);
  apart << 1, 3;
  EXPECT_FALSE(whole_solution(twice, apart, {0, 0}));
  apart << 1, 2;
  EXPECT_TRUE(whole_solution(twice, apart, {0, 0}));
}

}  // namespace
}  // namespace gainsmith::numerics
