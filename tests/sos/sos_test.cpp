#include <gtest/gtest.h>

#include "sos/counterexample.h"
#include "sos/squares.h"

namespace gainsmith::sos {
namespace {

using polynomial::PolynomialMatrix;
using polynomial::Term;
using tests::Answer;
using tests::ask;

Polynomial variable(std::size_t i) { return Polynomial(Term{Monomial(i), 0}); }
const Polynomial x = variable(0), y = variable(1);

Polynomial power(const Polynomial& p, int k) {
  Polynomial result(1);
  for (; k > 0; --k) result *= p;
  return result;
}

Statement scalar(const Polynomial& p, bool strict = false) {
  return {"p", PolynomialMatrix::Constant(1, 1, p), strict};
}

const Polynomial motzkin =
    power(x, 4) * y * y + x * x * power(y, 4) - Polynomial(3) * x * x * y * y + Polynomial(1);

TEST(SumsOfSquares, OfMotzkinsPolynomialThereAreNone) {
  EXPECT_EQ(ask(scalar(motzkin)), Answer::no);
  EXPECT_EQ(ask(scalar(motzkin * (x * x + y * y))), Answer::yes);
  EXPECT_EQ(
      ask(scalar((motzkin + Polynomial(Rational(1, 1000))) * (x * x + y * y + Polynomial(1)))),
      Answer::yes);
}

TEST(SumsOfSquares, ThePlainStepsDropWhatIsZero) {
  Program program = pose({scalar(motzkin)}, 0);
  const auto found = reduce(program);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->key.monomial, Monomial(std::vector<int>({2, 2})));
  EXPECT_NE(found->why.find("-3"), std::string::npos) << found->why;
}

TEST(SumsOfSquares, WithIrrationalZerosHaveFractions) {
  const Polynomial p = x * x - Polynomial(2);  // (x^2 - 2)^2 + (x y)^2 is 0 at (+-sqrt 2, 0)
  EXPECT_EQ(ask(scalar(p * p + x * x * y * y)), Answer::yes);
  EXPECT_EQ(ask(scalar(p * p + x * x * y * y - Polynomial(Rational(1, 1000000)))), Answer::no);
}

TEST(SumsOfSquares, StrictOnesStayAboveAConstant) {
  EXPECT_EQ(ask(scalar(x * x + y * y, true)), Answer::no);
  EXPECT_EQ(ask(scalar(x * x + y * y + Polynomial(1), true)), Answer::yes);
}

TEST(SumsOfSquares, HoldWhereOtherPolynomialsAreNotNegative) {
  // On the unit disc 1 - x > -1/2, and not 1/2 - x >= 0.
  Statement inside = scalar(Polynomial(1) - x + Polynomial(Rational(1, 2)), true);
  inside.nonnegative = {Polynomial(1) - x * x - y * y};
  EXPECT_EQ(ask(inside), Answer::yes);
  Statement outside = scalar(Polynomial(Rational(1, 2)) - x);
  outside.nonnegative = inside.nonnegative;
  EXPECT_EQ(ask(outside), Answer::no);
}

TEST(SumsOfSquares, HoldOnTheCircle) {
  // 2 + x y >= 0 where x^2 + y^2 = 1; xy >= -1/2 there, and no more.
  Statement circle = scalar(x * y + Polynomial(Rational(1, 2)));
  circle.zero = {x * x + y * y - Polynomial(1)};
  EXPECT_EQ(ask(circle), Answer::yes);
  circle.matrix(0, 0) = x * y + Polynomial(Rational(499, 1000));
  EXPECT_EQ(ask(circle), Answer::no);
}

TEST(SumsOfSquares, OfMatrices) {
  PolynomialMatrix M(2, 2);
  M << Polynomial(1) + x * x, x, x, Polynomial(2);
  EXPECT_EQ(ask({"M", M, true}), Answer::yes);
  M(1, 1) = Polynomial(1);  // > 0 for each x, and above no c I, as its determinant is 1
  EXPECT_EQ(ask({"M", M, false}), Answer::yes);
  EXPECT_NE(ask({"M", M, true}), Answer::yes);
  M(1, 1) = Polynomial(Rational(1, 2));  // det = (1 - x^2)/2
  EXPECT_EQ(ask({"M", M, false}), Answer::no);
}

TEST(SumsOfSquares, WithoutVariablesAreDefiniteMatrices) {
  PolynomialMatrix M(2, 2);
  M << Polynomial(2), Polynomial(1), Polynomial(1), Polynomial(1);
  EXPECT_EQ(ask({"M", M, true}), Answer::yes);
  M(1, 1) = Polynomial(Rational(1, 3));
  EXPECT_EQ(ask({"M", M, false}), Answer::no);
}

TEST(SumsOfSquares, TooManyMonomialsAreRefused) {
  EXPECT_THROW((void)pose({scalar(power(variable(11), 12))}, 0), std::length_error);
}

TEST(Counterexamples, AreFoundInFractions) {
  const auto found = find_counterexample(scalar(power(x, 4) - Polynomial(3) * x * y + power(y, 4)));
  ASSERT_TRUE(found);
  EXPECT_LT(found->value, 0);
  EXPECT_FALSE(find_counterexample(scalar(motzkin)));
  Statement inside = scalar(Polynomial(Rational(1, 2)) - x);
  inside.nonnegative = {Polynomial(1) - x * x - y * y};
  const auto near_edge = find_counterexample(inside);
  ASSERT_TRUE(near_edge);
  EXPECT_GT(near_edge->x[0], Rational(1, 2));
  PolynomialMatrix M(2, 2);
  M << Polynomial(1) + x * x, x, x, Polynomial(Rational(1, 2));
  EXPECT_TRUE(find_counterexample({"M", M, false}));
}

TEST(Conditions, AreMetByDecimals) {
  Equation third;  // 3 a - b = 0: any a, b = 3 a
  third.terms = {{0, 3}, {1, -1}};
  const auto found = decimals_near({0.1234567890123456, 0.37}, {third});
  ASSERT_TRUE(found);
  EXPECT_EQ(3 * (*found)[0], (*found)[1]);
  EXPECT_EQ(exact_text((*found)[0]).find('/'), std::string::npos);
  Equation fixed;  // 3 a = 1 has no decimals
  fixed.terms = {{0, 3}};
  fixed.value = 1;
  EXPECT_FALSE(decimals_near({0.33, 1}, {fixed}));
}

}  // namespace
}  // namespace gainsmith::sos
