#include "io/json/json_text.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>

#include "base/number.h"
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

TEST(JsonText, AKeyThatStandsTwiceIsRefusedAtItsPlace) {
  const auto refusal = [](const std::string& text) {
    return input_error([&] { parse_json(text, "f"); });
  };
  const InputError outer = refusal("{\"a\": 1,\n \"b\": 2,\n  \"a\": 3}");
  EXPECT_EQ(outer.place(), (Place{"f", 3, 3}));
  EXPECT_EQ(outer.message(), "the key 'a' is given twice; first in line 1");
  EXPECT_EQ(refusal(R"([{"x": {"\"q": 1, "\"q": 2}}])").place(), (Place{"f", 1, 19}));
  // The same key in two objects is none.
  EXPECT_EQ(parse_json(R"({"a": {"k": 1}, "b": {"k": 2}, "k": [{"k": 3}, {"k": 4}]})", "f").size(),
            3U);
}

TEST(JsonText, ManyKeysTakeNoLonger) {
  std::string text = "{\"k\": 0";
  for (int i = 0; i < 200'000; ++i) text += ", \"k" + std::to_string(i) + "\": 1";
  EXPECT_EQ(parse_json(text + "}", "f").size(), 200'001U);
}

TEST(JsonText, DecimalsAreWrittenAsTheyWereRead) {
  for (const std::string decimal :
       {"0.1", "1e-1", "1E5", "1.50", "-0.0", "-2.5e+0300", "123456789012345678901234567890", "0",
        "3", "-7", "18446744073709551615", "1e-400",
        "3.14159265358979323846264338327950288419716"}) {
    const std::string text = "{\n  \"x\": " + decimal + "\n}\n";
    const Json document = parse_json(text, "f");
    EXPECT_EQ(to_text(document), text);
    EXPECT_TRUE(is_number(document["x"]));
    EXPECT_EQ(decimal_of(document["x"]), decimal);
    EXPECT_EQ(number_of(document["x"]), parse_decimal(decimal));
  }
  EXPECT_EQ(decimal_of(parse_json("-0", "f")), "0") << "a whole number has no sign at zero";
}

TEST(JsonText, NumbersAsTheyArePrintedStayDoubles) {
  const Json document = parse_json("[0.1, 0.30000000000000004, 1e+100, 7]", "f");
  EXPECT_TRUE(document[0].is_number_float());
  EXPECT_TRUE(document[1].is_number_float());
  EXPECT_TRUE(document[2].is_number_float());
  EXPECT_TRUE(document[3].is_number_integer());
}

/// The parser builds what nlohmann's own builds.
TEST(ParseJson, BuildsTheDocument) {
  const std::string text =
      "{\"b\": [[], {}, [1, -2, 2.5, true, false, null, \"t\\n\"], [[[\"deep\"]]]], \"a\": {\"c\": "
      "{\"d\": 1}, \"e\": []}, \"b2\": 18446744073709551615}";
  EXPECT_EQ(parse_json(text, "f"), Json::parse(text));
  EXPECT_EQ(parse_json("7", "f"), Json(7));
  EXPECT_EQ(parse_json("\"t\"", "f"), Json("t"));
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
  expect("[0e-2000, 1,\n -1.5e-2147483648]", 2, 2,
         "-1.5e-2147483648 is beyond the range of double");
  expect("1e-2000", 1, 1, "1e-2000 is beyond the range of double");
  expect("{\"1e999\": [2,\n 1e999 ]}", 2, 2, "the number 1e999 is beyond the range of double");
}

TEST(ParseJson, DeepNestingDoesNotExhaustTheStack) {
  const auto nested = [](std::size_t depth) {
    return std::string(depth, '[') + std::string(depth, ']');
  };
  EXPECT_TRUE(parse_json(nested(500), "f").is_array());
  for (const std::size_t depth : {501UL, 100'000UL}) {
    const InputError error = input_error([&] { parse_json(nested(depth), "f"); });
    EXPECT_EQ(error.place(), (Place{"f", 1, 501})) << depth;
    EXPECT_NE(error.message().find("nested too deeply"), std::string::npos) << error.message();
  }
}

}  // namespace
}  // namespace gainsmith::io
