#include "hybrid/rounding_terms.h"

#include <gtest/gtest.h>

#include <optional>

#include "support/text_problem.h"

namespace gainsmith::hybrid {
namespace {

/// Of a text in x = [-3; 2] and s = 0.5; none where nothing is computed.
std::optional<numbers::Matrix> terms(const std::string& text) {
  tests::TextProblem problem;
  problem.state("x", "2").state("s", "scalar");
  const auto program = rounding_terms(problem.program(text));
  if (!program) return std::nullopt;
  return numbers::evaluate(
      *program, {{"x", Eigen::Vector2d(-3, 2)}, {"s", numbers::Matrix::Constant(1, 1, 0.5)}});
}

double term(const std::string& text) { return terms(text).value()(0); }

TEST(RoundingTerms, AreTheSizesOfWhatIsAddedUp) {
  EXPECT_EQ(term("x(1) + 2*x(2)"), 7);
  EXPECT_EQ(term("s*(x(1) - x(2))"), 2.5);
  EXPECT_EQ(term("[1, 1]*x"), 5);
  EXPECT_EQ(term("(x(1) + x(2))/(-2)"), 2.5);
}

TEST(RoundingTerms, NothingIsComputedWhereAValueIsChosen) {
  for (const char* text : {"x", "[x(2); x(1)]", "max(x(1), s)", "where(s > 0, x, -x)", "0.2"})
    EXPECT_FALSE(terms(text)) << text;
  EXPECT_EQ(term("clip(2*x(2), -s, s)"), 0);
  EXPECT_EQ(term("clip(2*x(2), -9, 9)"), 4);
  EXPECT_EQ(term("max(2*x(1), s)"), 0);
  EXPECT_EQ(term("min(2*x(1), s)"), 6);
  EXPECT_EQ(term("where(s > 0, s, 2*s)"), 0);
  EXPECT_EQ(term("where(s < 0, s, 2*s)"), 1);
  EXPECT_EQ(term("abs(min(2*x(1), s))"), 6);
  EXPECT_EQ(*terms("[min(2*x(2), s); x(1) + x(2)]"), numbers::Matrix(Eigen::Vector2d(0, 5)));
}

TEST(RoundingTerms, WhatIsChosenWithinASumCounts) { EXPECT_EQ(term("1 + max(x(1), s)"), 4); }

TEST(RoundingTerms, OfASignAreThoseOfTheArguments) {
  tests::TextProblem problem;
  problem.state("x", "2").state("s", "scalar");
  const auto of = [&](const std::string& text) {
    return numbers::evaluate(
        terms_of_sign(problem.program(text)),
        {{"x", Eigen::Vector2d(-3, 2)}, {"s", numbers::Matrix::Constant(1, 1, 0.5)}})(0);
  };
  EXPECT_EQ(of("abs(x(1) + x(2)) - s"), 5.5);
  EXPECT_EQ(of("sin(x(1) + 3)"), 6);
  EXPECT_NEAR(of("atan2(sin(x(1) + 3), cos(s - s))"), 7, 1e-15);
}

}  // namespace
}  // namespace gainsmith::hybrid
