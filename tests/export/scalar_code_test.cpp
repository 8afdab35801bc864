// Programs as statements on numbers.
#include "export/scalar_code.h"

#include <gtest/gtest.h>

#include <string>

#include "expr/binding/compile.h"
#include "expr/text/parser.h"

namespace gainsmith::exports {
namespace {

const Dialect kC{Language::c, false, "m_"};
const Dialect kSingle{Language::c, true, "m_"};
const Dialect kMatlab{Language::matlab, false, ""};
const Dialect kPython{Language::python, false, ""};

class ScalarCode : public testing::Test {
 protected:
  Code code(const std::string& text, const Dialect& dialect) const {
    expr::Scope scope;
    scope.symbols = {
        {"a", {{1, 1}}}, {"b", {{1, 1}}}, {"v", {{2, 1}}}, {"k", {{1, 1}}}, {"S", {{2, 2}}}};
    return scalar_code(
        {expr::compile(expr::parse({text, "test"}), scope)},
        {{"a", {"a"}}, {"b", {"b"}}, {"v", {"v[0]", "v[1]"}}, {"S", {"s1", "s2", "s3", "s4"}}},
        {{"k", numbers::Matrix::Constant(1, 1, 0.5)}}, dialect);
  }
  std::string number(const std::string& text, const Dialect& dialect) const {
    const Code made = code(text, dialect);
    EXPECT_TRUE(made.lines.empty()) << made.lines.front();
    return made.results.at(0).at(0);
  }
};

TEST_F(ScalarCode, ParenthesesKeepTheOrder) {
  EXPECT_EQ(number("a - (b - k)", kC), "a - (b - 0.5)");
  EXPECT_EQ(number("a - b - k", kC), "a - b - 0.5");
  EXPECT_EQ(number("a/(b/k)", kC), "a/(b/0.5)");
  EXPECT_EQ(number("(a + b)/(a - b)", kC), "(a + b)/(a - b)");
  EXPECT_EQ(number("-(a + b)", kC), "-(a + b)");
  EXPECT_EQ(number("b/(-a)", kC), "b/(-a)");
}

TEST_F(ScalarCode, NumbersAreReadBack) {
  EXPECT_EQ(number_text(2, kC), "2.0");
  EXPECT_EQ(number_text(0.1, kC), "0.1");
  EXPECT_EQ(number_text(1e-30, kC), "1e-30");
  EXPECT_EQ(number_text(0.1F, kSingle), "0.100000001f");
  EXPECT_EQ(std::stof(number_text(16777217.0 / 3, kSingle)), static_cast<float>(16777217.0 / 3));
  EXPECT_EQ(number("k*a", kSingle), "0.5f*a");
}

TEST_F(ScalarCode, EachLanguageHasItsFunctions) {
  EXPECT_EQ(number("exp(a)", kC), "exp(a)");
  EXPECT_EQ(number("exp(a)", kSingle), "expf(a)");
  EXPECT_EQ(number("exp(a)", kPython), "math.exp(a)");
  EXPECT_EQ(number("exp(a)", kMatlab), "exp(a)");
  EXPECT_EQ(number("max(a, b)", kC), "m_max(a, b)");
  EXPECT_EQ(number("max(a, b)", kPython), "max(a, b)");
  EXPECT_EQ(number("where(a > b, a, k)", kC), "a - b > 0.0 ? a : 0.5");
  EXPECT_EQ(number("where(a > b, a, k)", kPython), "a if a - b > 0 else 0.5");
  EXPECT_EQ(number("where(a > b, a, k)", kMatlab), "choose(a - b > 0, a, 0.5)");
  EXPECT_EQ(number("mod(a, b)", kPython), "a % b");
}

TEST_F(ScalarCode, WhatIsReadTwiceIsComputedOnce) {
  const Code made = code("[sin(a)*b; sin(a)]", kC);
  ASSERT_EQ(made.lines.size(), 1U);
  EXPECT_TRUE(made.lines[0].ends_with(" = sin(a);")) << made.lines[0];
}

TEST_F(ScalarCode, HelpersAreThoseThatAreUsed) {
  EXPECT_EQ(code("sign(a)", kC).helpers, std::set<std::string>{"sign"});
  const Code inverse = code("inv(S)*v", kC);
  EXPECT_EQ(inverse.helpers, std::set<std::string>{"inverse"});
  EXPECT_EQ(inverse.results[0].size(), 2U);
  const std::string text = helper_text(inverse.helpers, kSingle);
  EXPECT_NE(text.find("void m_inverse(int n, float *a, float *inverse)"), std::string::npos)
      << text;
  EXPECT_NE(text.find("fabsf("), std::string::npos);
  EXPECT_EQ(text.find('$'), std::string::npos);
}

TEST_F(ScalarCode, TheLibraryIsSaidToBeUsed) {
  for (const std::string text : {"sin(a)", "a^0.5", "mod(a, b)", "atan2(a, b)", "inv(S)*v"})
    EXPECT_TRUE(code(text, kC).library) << text;
  for (const std::string text : {"a*b", "max(a, b)", "sign(a)", "where(a > b, a, k)", "S*v"})
    EXPECT_FALSE(code(text, kC).library) << text;
}

TEST_F(ScalarCode, WhatHasNoFormulaIsNamed) {
  try {
    code("svd(S)", kC);
    FAIL();
  } catch (const NoCode& none) {
    EXPECT_NE(std::string(none.what()).find("svd"), std::string::npos) << none.what();
  }
}

}  // namespace
}  // namespace gainsmith::exports
