#include "io/yaml/yaml.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "expr/binding/compile.h"
#include "numbers/types/real.h"
#include "support/input_error.h"

namespace gainsmith::io {
namespace {

using tests::input_error;

/// "line:column" of every character of the value of the first key that is no white space.
std::string places(const std::string& yaml) {
  const YamlFile file(yaml, "f");
  const expr::Text text = file.scalar(file.root().begin()->second, "value");
  std::string result;
  for (std::size_t at = 0; at < text.str().size(); ++at) {
    if (text.str()[at] == ' ' || text.str()[at] == '\n') continue;
    const Place place = text.place(at);
    if (!result.empty()) result += ' ';
    result += text.str()[at] + std::to_string(place.line) + ":" + std::to_string(place.column);
  }
  return result;
}

TEST(Scalar, PlainTextKnowsItsPlaces) {
  EXPECT_EQ(places("k: a*b"), "a1:4 *1:5 b1:6");
  EXPECT_EQ(places("k:   a +\n     b\n"), "a1:6 +1:8 b2:6");
  EXPECT_EQ(places("k:\n  a +\n\n    b"), "a2:3 +2:5 b4:5");
  EXPECT_EQ(places("k: a\r\n  b\r\n"), "a1:4 b2:3");
}

/// Places count characters, in blocks of bytes that may end within one.
TEST(Scalar, KnowsItsPlaceOnALongLineOfCharactersOfManyBytes) {
  std::string line = "k: \"";
  for (int i = 0; i < 1000; ++i)
    line += i % 3 == 0 ? "\xC3\xA4" : i % 3 == 1 ? "\xE2\x89\xA4" : "a";
  const YamlFile file("first: 1\n" + line + "\"\n", "f");
  const expr::Text text = file.scalar(file.root()["k"], "value");
  EXPECT_EQ(text.place(text.str().size() - 1), (Place{"f", 2, 4 + 1000}));
  const YamlFile list("k: [" + line.substr(3) + "\", 7]\n", "f");
  EXPECT_EQ(list.place(list.root()["k"][1]), (Place{"f", 1, 4 + 1 + 1000 + 1 + 3}));
}

TEST(Scalar, NothingIsToldFromAWordForIt) {
  const auto message = [](const std::string& text) {
    const YamlFile file(text, "f");
    return input_error([&] { file.expression(file.root()["L"], "L"); }).message();
  };
  EXPECT_EQ(message("L:\nM: 1\n"), "L: the formula is missing");
  EXPECT_EQ(message("L: null\n"), "L: the formula is missing; YAML reads null and ~ as nothing");
  EXPECT_EQ(message("L: ~\n"), "L: the formula is missing; YAML reads null and ~ as nothing");
}

TEST(Scalar, QuotedTextKnowsItsPlaces) {
  EXPECT_EQ(places("k: \"a b\""), "a1:5 b1:7");
  EXPECT_EQ(places("k: \"a,\n     b\""), "a1:5 ,1:6 b2:6");
  EXPECT_EQ(places("k: 'a b'"), "a1:5 b1:7");
  EXPECT_EQ(places("k: 'a''*b'"), "a1:5 '1:7 *1:8 b1:9");
  EXPECT_EQ(places("k: 'a''''b'"), "a1:5 '1:7 '1:9 b1:10");
}

TEST(Scalar, EscapesStandForOneCharacter) {
  EXPECT_EQ(places("k: \"a\\\"b\""), "a1:5 \"1:6 b1:8");
  EXPECT_EQ(places("k: \"a\\x2Bb\""), "a1:5 +1:6 b1:10");
  EXPECT_EQ(places("k: \"a\\u002Bb\""), "a1:5 +1:6 b1:12");
  EXPECT_EQ(places("k: \"a\\tb\""), "a1:5 \t1:6 b1:8");
  EXPECT_EQ(places("k: \"a\\n  b\""), "a1:5 b1:10");
  EXPECT_EQ(places("k: \"ab\\\n   cd\""), "a1:5 b1:6 c2:4 d2:5");
}

TEST(Scalar, BlockTextKnowsItsPlaces) {
  EXPECT_EQ(places("k: |\n  a\n  b\n"), "a2:3 b3:3");
  EXPECT_EQ(places("k: >\n  a\n    b\n\n  c\n"), "a2:3 b3:5 c5:3");
  EXPECT_EQ(places("k: >-  # a remark\n  a\n  b\n"), "a2:3 b3:3");
  EXPECT_EQ(places("k: |2\n  a\n"), "a2:3");
}

TEST(Scalar, PropertiesAndAliasesPointToTheText) {
  EXPECT_EQ(places("k: !!str a*b"), "a1:10 *1:11 b1:12");
  EXPECT_EQ(places("k: &x \"a\""), "a1:8");
  const YamlFile file("a: &x u*v\nb: *x\n", "f");
  YamlMap map(file, file.root(), "m");
  EXPECT_EQ(file.scalar(map.require("b").value, "b").place(2), (Place{"f", 1, 9}));
}

/// Ten rows, each of ten aliases of the row before.
std::string bomb(int rows) {
  std::string text = "r0: &r0 [1, 1, 1, 1, 1, 1, 1, 1, 1, 1]\n";
  for (int k = 1; k < rows; ++k) {
    text += fmt::format("r{0}: &r{0} [", k);
    for (int i = 0; i < 10; ++i) text += fmt::format("{}*r{}", i > 0 ? ", " : "", k - 1);
    text += "]\n";
  }
  return text;
}

TEST(Aliases, StandForUpTo100000Values) {
  EXPECT_NO_THROW(YamlFile(bomb(4), "f"));
  std::string many = "r: &r [1, 2, 3]\nall: [";
  for (int k = 0; k < 10000; ++k) many += "*r, ";
  EXPECT_NO_THROW(YamlFile(many + "0]\n", "f"));
  // r1 to r4 stand for 11, 111, 1111, ... values in each of their places.
  const InputError error = input_error([] { YamlFile(bomb(12), "f"); });
  EXPECT_EQ(error.place().line, 5);
  EXPECT_NE(error.message().find("stand for more than 100000 values"), std::string::npos);
}

TEST(Aliases, OfWhatTheyArePartOfAreRefused) {
  for (const auto& [text, column] : {std::pair{"a: &a [*a]", 8},
                                     {"a: &a {b: [1, *a]}", 15},
                                     {"a: &a {<<: *a}", 12},
                                     {"a: &a [1, &b [*b]]", 15},
                                     {"a: &a {b: *a}", 11}}) {
    const InputError error = input_error([&] { YamlFile(text, "f"); });
    EXPECT_EQ(error.place(), (Place{"f", 1, column})) << text;
    EXPECT_NE(error.message().find("part of what it stands for"), std::string::npos) << text;
  }
  EXPECT_NO_THROW(YamlFile("a: &a [1]\nb: &a [2]\nc: [*a, *a]\n", "f"));
}

TEST(Scalar, ColumnsCountCharactersNotBytes) {
  EXPECT_EQ(places("k: \"\xC3\xBC\" # remark"), std::string("\xC3") + "1:5 \xBC" + "1:5");
  const YamlFile file("{a: \"f\xC3\xBCr \xE2\x89\xA4\", b: u*v}", "f");
  YamlMap map(file, file.root(), "m");
  EXPECT_EQ(map.require("b").place, (Place{"f", 1, 14}));
  EXPECT_EQ(file.scalar(map.require("b").value, "b").place(2), (Place{"f", 1, 19}));
}

TEST(Scalar, AByteOrderMarkTakesNoColumn) {
  EXPECT_EQ(places("\xEF\xBB\xBFk: a*b"), "a1:4 *1:5 b1:6");
}

TEST(Scalar, AMistakeInAMatrixOverSeveralLinesIsShownInItsLine) {
  const YamlFile file("k: \"[a, b;\n     c, d +]\"\n", "f");
  const auto error = input_error([&] { file.expression(file.root().begin()->second, "k"); });
  EXPECT_EQ(error.place(), (Place{"f", 2, 12}));
}

struct Broken {
  std::string yaml;
  Place place;
  std::string message;
};

void expect_refused(const Broken& broken) {
  const InputError error = input_error([&] { YamlFile(broken.yaml, "f"); });
  EXPECT_EQ(error.place(), broken.place) << broken.yaml.substr(0, 60) << ": " << error.what();
  EXPECT_NE(error.message().find(broken.message), std::string::npos) << error.what();
}

TEST(YamlFile, WhatIsNoDocumentIsRefused) {
  expect_refused({"", {"f"}, "empty"});
  expect_refused({"\n# a remark\n", {"f"}, "empty"});
  expect_refused({"---\n", {"f"}, "empty"});
  expect_refused({"~", {"f"}, "empty"});
  expect_refused({"a: b\n---\nc: d\n", {"f", 2, 1}, "second"});
  expect_refused({"---\n---\na: b\n", {"f", 2, 1}, "second"});
  expect_refused({"a: [1, 2\nb: 3\n", {"f", 1, 4}, "a ']' is missing"});
  expect_refused({"a: b\n]\n", {"f", 2, 1}, "YAML"});
  expect_refused({"a: b: c\n", {"f", 1, 5}, "YAML"});
  expect_refused({"\xC3\xBC: b: c\n", {"f", 1, 5}, "YAML"});
  expect_refused({"a: *b\n", {"f", 1, 4}, "YAML"});
}

TEST(YamlFile, WhatIsNoTextIsRefused) {
  expect_refused({std::string("a: b\nc: \0\n", 10), {"f", 2, 4}, "control characters"});
  expect_refused(
      {"\x7F"
       "ELF\x02\x01",
       {"f", 1, 5},
       "control characters"});
  expect_refused({"a: \xFC\n", {"f", 1, 4}, "no UTF-8"});
  expect_refused(
      {"# gr\xFC\xDF"
       "e\na: b\n",
       {"f", 1, 5},
       "no UTF-8"});
  expect_refused({"a: \xE2\x89", {"f", 1, 4}, "no UTF-8"});
  expect_refused({"a: \xC0\xAF", {"f", 1, 4}, "no UTF-8"});
}

TEST(YamlFile, NestingThatWouldExhaustTheStackIsRefused) {
  for (const std::string piece : {"[", "{", "- ", "? ", "{a: "}) {
    std::string yaml;
    for (int i = 0; i < 20000; ++i) yaml += piece;
    const InputError error = input_error([&] { YamlFile(yaml, "f"); });
    EXPECT_NE(error.message().find("YAML"), std::string::npos) << piece << error.what();
  }
}

void use(const std::string& yaml) {
  const YamlFile file(yaml, "f");
  YamlMap map(file, file.root(), "thing");
  map.require("name");
  map.find("size");
  map.finish();
}

TEST(YamlMap, MistakesInKeysAreShownWithASuggestion) {
  use("name: a\nsize: 2\n");
  const auto expect = [](const std::string& yaml, const Place& place, const std::string& message) {
    const InputError error = input_error([&] { use(yaml); });
    EXPECT_EQ(error.place(), place) << error.what();
    EXPECT_EQ(error.message(), message);
  };
  expect("name: a\nsise: 2\n", {"f", 2, 1}, "thing: unknown key 'sise'; did you mean 'size'?");
  expect("name: a\nwhatever: 2\n", {"f", 2, 1}, "thing: unknown key 'whatever'; known: name, size");
  expect("size: 2\nnmae: a\n", {"f", 2, 1}, "thing: unknown key 'nmae'; did you mean 'name'?");
  expect("size: 2\n", {"f", 1, 1}, "thing: the key 'name' is missing");
  expect("name: a\nsize: 1\n\nname: b\n", {"f", 4, 1},
         "thing: the key 'name' is given twice; first in line 1");
  expect("[1, 2]", {"f", 1, 1}, "thing: expected a mapping 'key: value', found a list");
  expect("word", {"f", 1, 1}, "thing: expected a mapping 'key: value', found 'word'");
  expect("name: a\n[1]: b\n", {"f", 2, 1}, "thing: a key: expected a text, found a list");
}

TEST(YamlMap, AReaderAsksForKeysOfItsTableAlone) {
  const YamlFile file("reset: [1, 2]\n", "f");
  YamlMap map(file, file.root(), "tau", keys::timer);
  EXPECT_TRUE(map.find("reset"));
  EXPECT_FALSE(map.find("first"));
  EXPECT_THROW(map.find("last"), std::logic_error);
}

TEST(YamlMap, AMissingValueIsShownBehindItsKey) {
  const YamlFile file("a: 1\nb:\n\nc: 2\n", "f");
  YamlMap map(file, file.root(), "m");
  const InputError error = input_error([&] { file.string(map.require("b").value, "b"); });
  EXPECT_EQ(error.place(), (Place{"f", 2, 3}));
  EXPECT_EQ(error.message(), "b: expected a text, found nothing");
}

TEST(Number, MustBeAFiniteDecimal) {
  const auto number = [](const std::string& text) {
    const YamlFile file("k: " + text, "f");
    return file.number(file.root().begin()->second, "k");
  };
  EXPECT_EQ(number("0.1"), 0.1);
  EXPECT_EQ(number("-1e-3"), -1e-3);
  for (const char* text : {".nan", ".inf", "nan", "1e999", "two", "1 2", "[1]", "{a: 1}", "0x10"})
    EXPECT_EQ(input_error([&] { number(text); }).place(), (Place{"f", 1, 4})) << text;
}

model::Value value(const std::string& yaml) {
  const YamlFile file(yaml, "f");
  YamlMap map(file, file.root(), "data");
  return value_of(file, map.items().front());
}

numbers::Matrix evaluated(const std::string& yaml) {
  return numbers::evaluate(expr::compile(value(yaml).value, {}), {});
}

TEST(Values, AreExpressionsListsOrListsOfLists) {
  const numbers::Matrix square{{1, -2}, {0.5, 4}};
  EXPECT_EQ(evaluated("A: [[1, -2], [0.5, 4]]"), square);
  EXPECT_EQ(evaluated("A:\n- [1, -2]\n- [1/2, 2^2]\n"), square);
  EXPECT_EQ(evaluated("A: \"[1, -2; 0.5, 4]\""), square);
  EXPECT_EQ(evaluated("A: [1, 2, 3]"), (numbers::Matrix{{1, 2, 3}}));
  EXPECT_EQ(evaluated("A: [[1], [2]]"), (numbers::Matrix{{1}, {2}}));
  EXPECT_EQ(evaluated("A: 7")(0, 0), 7);
  EXPECT_EQ(evaluated("A: [1 + 1, -1]"), (numbers::Matrix{{2, -1}}));
  EXPECT_TRUE(value("A: [1, 2]").flat);
  EXPECT_FALSE(value("A: [[1, 2]]").flat);
  EXPECT_FALSE(value("A: 1").flat);
}

TEST(Values, MistakesAreShownAtTheElement) {
  const auto expect = [](const std::string& yaml, int line, int column, const std::string& part) {
    const InputError error = input_error([&] { evaluated(yaml); });
    EXPECT_EQ(error.place(), (Place{"f", line, column})) << yaml << ": " << error.what();
    EXPECT_NE(error.message().find(part), std::string::npos) << error.what();
  };
  expect("A: [[1, 2], [3]]", 1, 13, "1 element, the first row has 2");
  expect("A: [[1, 2],\n    [3, 4, 5]]", 2, 5, "3 elements, the first row has 2");
  expect("A: [[1, 2], 3]", 1, 13, "expected a row");
  expect("A: [1, [2, 3]]", 1, 8, "found a list");
  expect("A: [[1, [2]]]", 1, 9, "found a list");
  expect("A: [[1, {a: 2}]]", 1, 9, "found a mapping");
  expect("A: [one, two]", 1, 5, "unknown name 'one'");
  expect("A: [[1, 2],\n    [3, four]]", 2, 9, "unknown name 'four'");
  expect("A: [.nan, 1]", 1, 5, "finite");
  expect("A: [1, -.inf]", 1, 9, "finite");
  expect("A: [1, nan]", 1, 8, "finite");
  expect("A: [1, 1e999]", 1, 8, "beyond the range");
  expect("A: [1, 2) + (3]", 1, 9, "found ')'");
  expect("A: [\"1; 2\", 3]", 1, 5, "must be quoted");
  expect("A: []", 1, 4, "empty");
  expect("A: [[]]", 1, 5, "this row is empty");
  expect("A: [1, ~]", 1, 8, "found nothing");
  expect("A: {a: 1}", 1, 4, "found a mapping");
  expect("A:\n", 1, 3, "the formula is missing");
  expect("A: '1 + 2\n", 1, 4, "not closed");
  expect("A: \"\"", 1, 5, "found nothing");
}

}  // namespace
}  // namespace gainsmith::io
