#include <gtest/gtest.h>

#include <set>

#include "expr/binding/compile.h"
#include "expr/text/parser.h"
#include "polynomial/polynomial_numbers.h"

namespace gainsmith::polynomial {
namespace {

Polynomial variable(std::size_t i) { return Polynomial(Term{Monomial(i), 0}); }
Polynomial unknown(int k) { return Polynomial(Term{{}, k}); }

/// A text in x, a column of two, and the unknown u.
Polynomial value(const std::string& text) {
  expr::Scope scope;
  scope.symbols["x"] = {{2, 1}};
  scope.symbols["u"] = {{1, 1}};
  const auto program = expr::compile(expr::parse(expr::Text::generated(text, {})), scope);
  PolynomialMatrix x(2, 1);
  x << variable(0), variable(1);
  const std::vector<std::string> names = {"u"};
  return polynomial_value(program, {{"x", x}, {"u", PolynomialMatrix::Constant(1, 1, unknown(1))}},
                          names)(0, 0);
}

TEST(Monomials, AreInOrderOfTheirDegree) {
  const std::vector<Monomial> all = monomials(2, 0, 2);
  std::string texts;
  for (const Monomial& m : all) texts += to_string(m, {"x", "y"}) + " ";
  EXPECT_EQ(texts, "1 x y x^2 x*y y^2 ");
  EXPECT_TRUE(std::is_sorted(all.begin(), all.end()));
  EXPECT_EQ(monomials(0, 0, 3).size(), 1U);
  EXPECT_EQ(monomials(4, 3, 4).size(), 20U + 35U);
}

TEST(Monomials, OfFewerVariablesAreThoseOfMore) {
  EXPECT_EQ(Monomial(std::vector<int>{1, 0, 0}), Monomial(0));
  EXPECT_EQ(Monomial(2) * Monomial(0), Monomial(std::vector<int>{1, 0, 1}));
  EXPECT_EQ(Monomial(std::vector<int>{1, 2}).without(1), Monomial(0));
}

TEST(Polynomials, AreARing) {
  const Polynomial x = variable(0), y = variable(1), u = unknown(1);
  EXPECT_EQ((x + y) * (x - y), x * x - y * y);
  EXPECT_EQ((x + y) * u - u * x, u * y);
  EXPECT_TRUE((x - x).is_number());
  EXPECT_EQ((x * x * y).degree(), 3);
  EXPECT_THROW((void)(u * (x + u)), std::logic_error);
}

TEST(Polynomials, HaveDerivativesAndValues) {
  const Polynomial x = variable(0), y = variable(1), p = x * x * y + unknown(2) * y;
  EXPECT_EQ(derivative(p, 0), Polynomial(2) * x * y);
  EXPECT_EQ(derivative(p, 1), x * x + unknown(2));
  EXPECT_EQ(substituted(p, 0, {Polynomial(3), x}), Polynomial(9) * x + unknown(2) * x);
  EXPECT_EQ(with_unknowns(p, {1, Rational(1, 3)}), x * x * y + y * Polynomial(Rational(1, 3)));
}

TEST(PolynomialNumbers, EvaluateTexts) {
  const Polynomial x = variable(0), y = variable(1), u = unknown(1);
  EXPECT_EQ(value("x'*x/3"), (x * x + y * y) * Polynomial(Rational(1, 3)));
  EXPECT_EQ(value("jacobian(u*x(1)^2*x(2), x)*[1; -x(1)]"),
            Polynomial(2) * u * x * y - u * x * x * x);
  EXPECT_EQ(value("trace([x(1), 1; 2, x(2)]^2)"), x * x + y * y + Polynomial(4));
}

TEST(PolynomialNumbers, DifferentiateAtWhatIsNoVariable) {
  expr::Scope scope;
  scope.symbols["x"] = {{2, 1}};
  scope.definitions["f"] = {{"z"}, expr::parse(expr::Text::generated("jacobian(z^3, z)", {}))};
  const auto program = expr::compile(expr::parse(expr::Text::generated("f(x(1)*x(2))", {})), scope);
  PolynomialMatrix x(2, 1);
  x << variable(0), variable(1);
  const Polynomial xy = variable(0) * variable(1);
  EXPECT_EQ(polynomial_value(program, {{"x", x}}, {})(0, 0), Polynomial(3) * xy * xy);
}

TEST(PolynomialNumbers, SayWhatIsNoPolynomialAndWhatMakesOne) {
  const auto message = [](const std::string& text) -> std::string {
    try {
      value(text);
    } catch (const expr::EvaluationError& error) {
      return error.message();
    }
    return "";
  };
  EXPECT_NE(message("sin(x(1))").find("s^2 + c^2 == 1"), std::string::npos);
  EXPECT_NE(message("x(1)/(1 + x(2)^2)").find("multiply the inequality"), std::string::npos);
  EXPECT_NE(message("u*(u + x(1))").find("a product of u and u"), std::string::npos);
  EXPECT_NE(message("x(1)^101").find("power above 100"), std::string::npos);
  EXPECT_EQ(message("sin(0)*x(1)"), "");
}

}  // namespace
}  // namespace gainsmith::polynomial
