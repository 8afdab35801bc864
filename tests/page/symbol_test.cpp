#include "page/symbol.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace gainsmith::page {
namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++found;
  return found;
}

TEST(Symbol, GreekLettersAndIndices) {
  EXPECT_EQ(symbol("tau"), "<mi>τ</mi>");
  EXPECT_EQ(symbol("QF"), "<mi>QF</mi>");
  EXPECT_EQ(symbol("P1"), "<msub><mi>P</mi><mn>1</mn></msub>");
  EXPECT_EQ(symbol("a_max"), "<msub><mi>a</mi><mi>max</mi></msub>");
  EXPECT_EQ(symbol("x_hat"), hatted("x"));
  EXPECT_EQ(symbol("A", {"<mi>i</mi>"}), "<msub><mi>A</mi><mi>i</mi></msub>");
}

TEST(Symbol, AnyTextIsEscaped) {
  EXPECT_EQ(symbol("<script>").find("<script>"), std::string::npos);
  for (const char* odd : {"", "_", "1", "a_", "_1", ".", "a.", "x__hat"})
    EXPECT_FALSE(symbol(odd).empty()) << odd;
}

TEST(Number, ExponentsArePowersOfTen) {
  EXPECT_EQ(number("0.5"), "<mn>0.5</mn>");
  EXPECT_EQ(number("-2"), "<mrow><mo>−</mo><mn>2</mn></mrow>");
  EXPECT_EQ(number("1e4"), "<msup><mn>10</mn><mn>4</mn></msup>");
  EXPECT_EQ(number("2.5e-07"),
            "<mrow><mn>2.5</mn><mo>×</mo><msup><mn>10</mn><mrow><mo>−</mo>"
            "<mn>7</mn></mrow></msup></mrow>");
}

TEST(Number, WhatIsNotFiniteHasAName) {
  EXPECT_NE(value(std::numeric_limits<double>::quiet_NaN()).find("not a number"),
            std::string::npos);
  EXPECT_NE(value(-std::numeric_limits<double>::infinity()).find("−"), std::string::npos);
}

TEST(Matrix, ALargeOneShowsItsCorners) {
  const numbers::Matrix small = numbers::Matrix::Ones(10, 10);
  EXPECT_EQ(count(matrix(small), "<mn>1</mn>"), 100U);
  const numbers::Matrix large = numbers::Matrix::Ones(2000, 3000);
  const std::string shown = matrix(large);
  EXPECT_EQ(count(shown, "<mn>1</mn>"), 49U);
  EXPECT_EQ(count(shown, "⋱"), 1U);
  EXPECT_LT(shown.size(), 3000U);
}

TEST(Matrix, OfNoElements) {
  EXPECT_EQ(matrix(numbers::Matrix(0, 3)), "<mtable class=\"m\"></mtable>");
}

TEST(Eigenvalues, PairsAreSaidOnce) {
  numbers::Matrix rows(3, 2);
  rows << -1, 2, -1, -2, -3, 0;
  EXPECT_EQ(count(eigenvalues(rows), "±"), 1U);
  EXPECT_EQ(count(eigenvalues(rows), "<mo>,</mo>"), 1U);
}

}  // namespace
}  // namespace gainsmith::page
