// Fractions: the number type, its linear algebra.
#include "numbers/types/rational.h"

#include <gtest/gtest.h>

#include <memory>
#include <random>

#include "expr/binding/compile.h"
#include "expr/binding/functions.h"
#include "expr/program/operations.h"
#include "expr/text/parser.h"
#include "numbers/dense/rational_algebra.h"
#include "numbers/examples.h"
#include "numbers/types/real.h"

namespace gainsmith::numbers {
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

expr::Program compiled(const std::string& text) {
  expr::Scope scope;
  scope.known = std::make_shared<KnownDoubles>(Values{});  // the ranks of orth and null
  scope.symbols["x"] = {{2, 1}};
  return expr::compile(expr::parse({text, "test"}), scope);
}

/// The operations that are refused are those without fractions.
TEST(RationalNumbersTest, EveryExampleIsExactOrRefused) {
  int exact = 0;
  const auto look = [&](const std::string& example, const std::string& value) {
    try {
      const RationalMatrix difference =
          rational_value(compiled("(" + example + ") - (" + value + ")"),
                         {{"x", example_inputs().at("x").cast<Rational>()}});
      ++exact;
      for (Eigen::Index i = 0; i < difference.size(); ++i) EXPECT_EQ(difference(i), 0) << example;
    } catch (const expr::EvaluationError& error) {
      EXPECT_NE(error.message().find("has no exact fraction"), std::string::npos)
          << example << ": " << error.message();
    }
  };
  for (const expr::Operation& row : expr::operations())
    if (!row.example.empty()) look(std::string(row.example), std::string(row.value));
  for (const expr::Operator& row : expr::operators())
    look(std::string(row.example), std::string(row.value));
  EXPECT_GE(exact, 25);
}

TEST(RationalNumbersTest, DecimalsAreThemselves) {
  EXPECT_EQ(rational_value(compiled("0.1 + 0.2 - 0.3"), {})(0), 0);
  EXPECT_EQ(rational_value(compiled("1/3 + 1/6"), {})(0), Rational(1, 2));
  EXPECT_EQ(rational_value(compiled("exp(0) + cos(0) - trace(expm(zeros(2)))"), {})(0), 0);
  EXPECT_THROW(rational_value(compiled("pi"), {}), expr::EvaluationError);
  EXPECT_THROW(rational_value(compiled("exp(1)"), {}), expr::EvaluationError);
  EXPECT_THROW(rational_value(compiled("inv([1, 2; 2, 4])"), {}), expr::EvaluationError);
  EXPECT_THROW(rational_value(compiled("1/(1 - 1)"), {}), expr::EvaluationError);
}

TEST(RationalAlgebraTest, SolvesWhatHasASolution) {
  Draws draws(1);
  for (int k = 0; k < 50; ++k) {
    const RationalMatrix M = draws.matrix(draws.between(1, 5), draws.between(1, 5));
    const RationalMatrix planted = draws.matrix(M.cols(), 2);
    const auto found = rational_solution(M, M * planted);
    ASSERT_TRUE(found);
    EXPECT_EQ(M * *found, M * planted);
  }
  RationalMatrix M(2, 2);
  M << 1, 2, 2, 4;
  RationalMatrix b(2, 1);
  b << 1, 3;
  EXPECT_FALSE(rational_solution(M, b));
  EXPECT_FALSE(rational_inverse(M));
}

TEST(RationalAlgebraTest, TellsSemidefiniteFromIndefiniteWithoutATolerance) {
  Draws draws(2);
  for (int k = 0; k < 50; ++k) {
    const int n = draws.between(2, 5);
    const int rank = draws.between(1, n);
    const RationalMatrix L = draws.matrix(n, rank);
    RationalMatrix M = L * L.transpose();
    EXPECT_TRUE(is_rational_semidefinite(M));
    if (rank < n) {
      EXPECT_FALSE(is_rational_definite(M));
      // Along a direction of its kernel M falls below 0 by any amount.
      const auto echelon = reduced_echelon(M);
      RationalMatrix v = RationalMatrix::Constant(n, 1, Rational(0));
      Eigen::Index free = 0;
      while (free < std::ssize(echelon.pivots) && echelon.pivots[free] == free) ++free;
      v(free) = 1;
      for (Eigen::Index r = 0; r < std::ssize(echelon.pivots); ++r)
        v(echelon.pivots[static_cast<std::size_t>(r)]) = -echelon.rows(r, free);
      M -= (v * v.transpose()) * power_of_ten(-60);
      EXPECT_FALSE(is_rational_semidefinite(M));
      for (const bool definite : {false, true}) {
        const RationalMatrix w = rational_witness(M, definite).value();
        EXPECT_FALSE(is_rational_zero(w));
        const Rational value = (w.transpose() * M * w)(0, 0);
        EXPECT_TRUE(definite ? value <= 0 : value < 0) << value;
      }
    }
  }
  EXPECT_TRUE(is_rational_definite(RationalMatrix(0, 0)));
  RationalMatrix zero_corner(2, 2);
  zero_corner << 0, 3, 3, 5;
  const RationalMatrix w = rational_witness(zero_corner, false).value();
  EXPECT_LT((w.transpose() * zero_corner * w)(0, 0), 0);
}

}  // namespace
}  // namespace gainsmith::numbers
