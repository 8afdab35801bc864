#include "page/lines.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "expr/binding/functions.h"
#include "page/mathml.h"
#include "page/rows.h"
#include "page/symbol.h"
#include "drawing/xml.h"

namespace gainsmith::page {
namespace {

std::string markup(const std::string& text) {
  Notation notation;
  notation.functions = {"f"};
  return mathml(expr::parse({text, "test.yaml"}), notation);
}

/// The texts of all elements, in their order.
std::string texts(const std::string& markup) {
  const auto found = test::read_xml("<p>" + markup + "</p>");
  EXPECT_TRUE(found) << markup;
  std::string text;
  for (const test::Element& one : found.value_or(std::vector<test::Element>{})) text += one.text;
  return text;
}

/// The <math> elements of a formula, with their tags.
std::vector<std::string> pieces(const std::string& formula) {
  std::vector<std::string> found;
  for (std::size_t at = 0; (at = formula.find("<math", at)) != std::string::npos;) {
    const std::size_t end = formula.find("</math>", at) + 7;
    found.push_back(formula.substr(at, end - at));
    at = end;
  }
  return found;
}

std::string sum_of(const std::string& term, int count) {
  std::string text = term;
  for (int k = 1; k < count; ++k) text += " + " + term;
  return text;
}

/// Many letters on one line and no room that is said: this does not fit on a phone.
bool is_too_wide(const std::string& piece) {
  const std::string text = texts(piece);
  const auto letters = std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) >> 6) != 2; });
  return letters > 40 && !piece.starts_with("<math style=\"--w:");
}

TEST(Lines, ANarrowFormulaIsOneElement) {
  for (const char* text : {"P > I", "a + b", "[1, 2; 3, 4]", "x"})
    EXPECT_EQ(formula(markup(text)), "<math>" + markup(text) + "</math>");
  EXPECT_EQ(formula("<mi>n</mi><mo>×</mo><mi>p</mi>"),
            "<math><mrow><mi>n</mi><mo>×</mo><mi>p</mi></mrow></math>");
}

TEST(Lines, ASumBreaksBeforeItsSigns) {
  const auto found = pieces(formula(markup(sum_of("a*b*c*d*e", 9) + " - f*g*h*i*j < 0")));
  ASSERT_EQ(found.size(), 10u);
  for (std::size_t k = 1; k < 9; ++k)
    EXPECT_TRUE(found[k].starts_with("<math><mo form=\"infix\">+</mo>")) << found[k];
  EXPECT_TRUE(found[9].starts_with("<math><mo form=\"infix\">−</mo>")) << found[9];
  EXPECT_TRUE(found[9].ends_with("<mo>&lt;</mo><mn>0</mn></math>")) << "what is short stays";
}

TEST(Lines, ASignOfOneOperandStaysOne) {
  const auto found =
      pieces(formula(equation("<mi>x</mi>", markup("-(" + sum_of("a*b*c*d*e", 9) + ")"))));
  ASSERT_GT(found.size(), 3u);
  EXPECT_NE(found[0].find("<mo form=\"prefix\">−</mo>"), std::string::npos) << found[0];
}

TEST(Lines, ListsBreakBehindCommas) {
  const auto found = pieces(formula(markup("f(" + sum_of("a*b*c*d*e", 2) + ", " +
                                           sum_of("p*q*r*s*t", 2) + ", u*v*w*x*y*z*a*b)")));
  ASSERT_EQ(found.size(), 3u);
  EXPECT_TRUE(found[0].ends_with("<mo>,</mo></math>")) << found[0];
  EXPECT_TRUE(found[1].ends_with("<mo>,</mo></math>")) << found[1];
}

TEST(Lines, ParenthesesBreakAfterWhatIsOutside) {
  const std::string wide = "(" + sum_of("a*b*c*d", 6) + ")*x";
  const std::string text = formula(markup(wide + " + " + wide));
  // Each of the two terms is a part of its own, with lines only if one has no room for it.
  const std::string part = "<span class=\"part\">";
  EXPECT_TRUE(text.starts_with(part + part)) << text;
  EXPECT_NE(text.find("</span>" + part + "<math><mo form=\"infix\">+</mo>"), std::string::npos)
      << text;
}

TEST(Lines, AWideMatrixHasItsWidth) {
  std::string row = "123456.5";
  for (int k = 1; k < 6; ++k) row += ", 123456.5";
  const auto found = pieces(formula(markup("[" + row + "]")));
  ASSERT_EQ(found.size(), 1u);
  const std::string begin = "<math style=\"--w:";
  ASSERT_TRUE(found[0].starts_with(begin)) << found[0];
  const int width = std::stoi(found[0].substr(begin.size()));
  EXPECT_GE(width, 6 * (8 * 0.55 + 0.8));  // digits of 0.55 em, the room of a cell
  EXPECT_LE(width, 6 * (8 * 0.66 + 1));
}

TEST(Lines, NothingIsLostAndNothingStaysWide) {
  std::vector<std::string> examples;
  for (const expr::Function& function : expr::functions()) examples.emplace_back(function.example);
  for (const expr::Operator& one : expr::operators()) examples.emplace_back(one.example);
  for (std::size_t k = 0; k < examples.size(); ++k) {
    const std::string inside = markup(examples[k]);
    const std::string list =
        listed({inside, fenced(inside), row(inside + mo("+") + inside), inside, inside});
    for (const std::string& one : {inside, list, fenced(list), equation(inside, fenced(list))}) {
      const std::string text = formula(one);
      EXPECT_EQ(texts(text), texts(one)) << examples[k];
      for (const std::string& piece : pieces(text)) EXPECT_FALSE(is_too_wide(piece)) << piece;
    }
  }
}

TEST(Lines, EmptyMarkupIsNoError) {
  EXPECT_EQ(formula(""), "<math><mrow></mrow></math>");
  EXPECT_EQ(formula(symbol("")), "<math><mi></mi></math>");
  EXPECT_EQ(formula(table(0, 0, {})), "<math><mtable class=\"m\"></mtable></math>");
}

}  // namespace
}  // namespace gainsmith::page
