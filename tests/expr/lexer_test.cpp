#include "expr/text/lexer.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "support/input_error.h"

namespace gainsmith::expr {
namespace {

using tests::input_error;
using enum TokenKind;

std::vector<TokenKind> kinds(const std::string& text) {
  std::vector<TokenKind> result;
  for (const Token& token : tokenize({text, "f"})) result.push_back(token.kind);
  return result;
}

TEST(Lexer, KnowsEverySymbol) {
  EXPECT_EQ(kinds("+ - * / ^ ' , ; : ( ) [ ] < <= > >= a 1"), (std::vector{plus,
                                                                           minus,
                                                                           star,
                                                                           slash,
                                                                           caret,
                                                                           quote,
                                                                           comma,
                                                                           semicolon,
                                                                           colon,
                                                                           TokenKind::open,
                                                                           TokenKind::close,
                                                                           open_bracket,
                                                                           close_bracket,
                                                                           less,
                                                                           less_equal,
                                                                           greater,
                                                                           greater_equal,
                                                                           name,
                                                                           number,
                                                                           TokenKind::end}));
}

TEST(Lexer, ANumberIsKeptAsWritten) {
  for (const std::string text : {"0", "0.1", "1.", ".5", "1e5", "1E-5", "1.5e+05", "007"}) {
    const auto tokens = tokenize({text, "f"});
    ASSERT_EQ(tokens.size(), 2U) << text;
    EXPECT_EQ(tokens[0].kind, number);
    EXPECT_EQ(tokens[0].text, text);
  }
}

TEST(Lexer, AnExponentNeedsDigits) {
  EXPECT_EQ(kinds("2e"), (std::vector{number, name, TokenKind::end}));
  EXPECT_EQ(kinds("2e+x"), (std::vector{number, name, plus, name, TokenKind::end}));
}

TEST(Lexer, NamesMayHoldDigitsAndUnderscores) {
  const auto tokens = tokenize({"P1 _x a_2b", "f"});
  ASSERT_EQ(tokens.size(), 4U);
  EXPECT_EQ(tokens[0].text, "P1");
  EXPECT_EQ(tokens[1].text, "_x");
  EXPECT_EQ(tokens[2].text, "a_2b");
}

TEST(Lexer, TokensKnowTheirBytes) {
  const auto tokens = tokenize({" ab <=\n1.5", "f"});
  ASSERT_EQ(tokens.size(), 4U);
  EXPECT_EQ(std::pair(tokens[0].begin, tokens[0].end), std::pair(std::size_t{1}, std::size_t{3}));
  EXPECT_EQ(std::pair(tokens[1].begin, tokens[1].end), std::pair(std::size_t{4}, std::size_t{6}));
  EXPECT_EQ(std::pair(tokens[2].begin, tokens[2].end), std::pair(std::size_t{7}, std::size_t{10}));
  EXPECT_EQ(tokens[3].begin, 10U);
}

TEST(Lexer, ThePointBelongsToTheOperator) {
  for (const char* text : {"2.*v", "2.0.*v", "2 .*v", "2.* v"}) {
    const auto tokens = tokenize({text, "f"});
    ASSERT_EQ(tokens.size(), 4U) << text;
    EXPECT_EQ(tokens[1].text, ".*") << text;
  }
  EXPECT_EQ(tokenize({"2./v", "f"})[0].text, "2");
  EXPECT_EQ(tokenize({"2.^v", "f"})[1].kind, TokenKind::point_caret);
  EXPECT_EQ(tokenize({"2.5./v", "f"})[0].text, "2.5");
  EXPECT_EQ(tokenize({"2..^v", "f"})[1].kind, TokenKind::dots);
  EXPECT_EQ(tokenize({"2.", "f"})[0].text, "2.");
  EXPECT_EQ(tokenize({"2.+v", "f"})[0].text, "2.");
}

TEST(Lexer, NothingIsTheEndAlone) {
  EXPECT_EQ(kinds(""), std::vector{TokenKind::end});
  EXPECT_EQ(kinds(" \t\n"), std::vector{TokenKind::end});
}

TEST(Lexer, SpellingsOfOtherLanguagesAreExplained) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"=", "'let'"},        {".nan", "finite"},     {".NaN", "finite"},     {".NAN", "finite"},
      {".inf", "finite"},    {".Inf", "finite"},     {".INF", "finite"},     {"&", "chain"},
      {"\xE2\x88\x92", "-"}, {"\xE2\x89\xA4", "<="}, {"\xE2\x89\xA5", ">="}, {"\xE2\x80\x99", "'"}};
  for (const auto& [spelling, advice] : cases) {
    const InputError error = input_error([&] { tokenize({"ab " + spelling + " c", "f"}); });
    EXPECT_EQ(error.place(), (Place{"f", 1, 4})) << error.what();
    EXPECT_NE(error.message().find(advice), std::string::npos) << error.what();
  }
}

TEST(Lexer, UnknownCharactersAreQuotedWhole) {
  const InputError error = input_error([] { tokenize({"a + \xCE\xB4", "f"}); });
  EXPECT_EQ(error.place(), (Place{"f", 1, 5}));
  EXPECT_EQ(error.message(), "unexpected character '\xCE\xB4'");
  for (const char* text : {"!", "@", "#", "$", "%", "{", "}", "|", "\\", "\"", "?", "~", "`"})
    input_error([&] { tokenize({text, "f"}); });
}

}  // namespace
}  // namespace gainsmith::expr
