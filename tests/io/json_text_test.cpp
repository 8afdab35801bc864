#include "io/json_text.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>

#include "support/input_error.h"

namespace gainsmith::io {
namespace {

using tests::input_error;

TEST(JsonText, StandsListsOfScalarsOnOneLine) {
  const Json document = {{"a", {1.5, 2, 3}}, {"b", Json::object()}, {"c", {{1, 2}, {3, 4}}}};
  EXPECT_EQ(
      to_text(document),
      "{\n  \"a\": [1.5, 2, 3],\n  \"b\": {},\n  \"c\": [\n    [1, 2],\n    [3, 4]\n  ]\n}\n");
}

TEST(JsonText, AnyFiniteNumberIsReadBackToTheSameBits) {
  std::mt19937_64 random(1);
  const auto check = [](double value) {
    const std::string text = to_text({{"x", value}});
    const Json back = parse_json(text, "f");
    EXPECT_EQ(std::bit_cast<std::uint64_t>(back["x"].get<double>()),
              std::bit_cast<std::uint64_t>(value))
        << text;
  };
  for (int i = 0; i < 20000; ++i) {
    const auto value = std::bit_cast<double>(random());
    if (std::isfinite(value)) check(value);
  }
  using Limits = std::numeric_limits<double>;
  for (const double value : {0.0, -0.0, 1.0, 1e308, -1e308, Limits::max(), Limits::denorm_min(),
                             -Limits::denorm_min(), Limits::min(), 1e15, 1e16, 1e17, 1e19, 0.1})
    check(value);
}

TEST(JsonText, WhatIsNotFiniteIsRefused) {
  EXPECT_THROW(to_text({{"x", std::nan("")}}), std::invalid_argument);
  EXPECT_THROW(to_text({{"x", std::numeric_limits<double>::infinity()}}), std::invalid_argument);
}

TEST(JsonText, BytesThatAreNoUtf8AreReplaced) {
  const std::string text = to_text({{"file", "gr\xFC.yaml"}, {"k\xFC", 1}});
  const Json back = parse_json(text, "f");
  EXPECT_EQ(back["file"], "gr\xEF\xBF\xBD.yaml");
  EXPECT_EQ(to_text(back), text);
}

TEST(JsonText, TextsKeepTheirBytes) {
  const std::string awkward = "quote \" backslash \\ newline \n tab \t bell \x07 \xC3\xBC";
  EXPECT_EQ(parse_json(to_text({{awkward, awkward}}), "f")[awkward], awkward);
}

TEST(ParseJson, MistakesAreShownWhereTheyAre) {
  const auto expect = [](const std::string& text, int line, int column, const std::string& part) {
    const InputError error = input_error([&] { parse_json(text, "f"); });
    EXPECT_EQ(error.place(), (Place{"f", line, column})) << text << ": " << error.what();
    EXPECT_NE(error.message().find(part), std::string::npos) << error.what();
  };
  expect("", 0, 0, "empty");
  expect(" \n\t", 0, 0, "empty");
  expect("{\"a\": 1,\n \"b\": }", 2, 7, "syntax error");
  expect("{\"\xC3\xBC\": ]", 1, 7, "syntax error");
  expect("{\"a\": nan}", 1, 8, "syntax error");
  expect("{\"a\": 1}\n}", 2, 1, "syntax error");
  expect("{\n\"a\": 1e999}", 2, 6, "1e999 is beyond the range of double");
  expect("{\"a\": 1", 1, 8, "unexpected end of input");
}

TEST(ParseJson, DeepNestingDoesNotExhaustTheStack) {
  const std::string open(100000, '[');
  input_error([&] { parse_json(open, "f"); });
  EXPECT_TRUE(parse_json(open + std::string(100000, ']'), "f").is_array());
}

}  // namespace
}  // namespace gainsmith::io
