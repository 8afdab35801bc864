#include "io/json/json_fields.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "io/problem_text.h"

namespace gainsmith::io {
namespace {

using tests::input_error;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Part {
  std::string name;
  int weight = 1;
};

struct Whole {
  double value = 0;
  std::optional<double> bound;
  std::optional<std::uint64_t> runs;
  std::vector<std::string> notes;
  std::vector<Part> parts;
  std::map<std::string, double> named;
  model::Verdict verdict = model::Verdict::undecided;
  std::array<std::int64_t, 2> ends{};
  numbers::Matrix M;
};

constexpr auto kPartFields = [](auto& at, auto& part) {
  at.name("name", part.name);
  at.some_but("weight", part.weight, 1);
};

constexpr auto kWholeFields = [](auto& at, auto& whole) {
  at("value", whole.value);
  at("bound", whole.bound);
  at.some("runs", whole.runs);
  at.some("notes", whole.notes);
  at("parts", whole.parts, kPartFields);
  at("named", whole.named);
  at("verdict", whole.verdict);
  at("ends", whole.ends);
  at.loose("M", whole.M);
};

Whole whole_of(const std::string& text, JsonNumbers numbers = JsonNumbers::finite) {
  const Json document = Json::parse(text);
  const JsonReader reader(document, "d.json");
  Whole whole;
  read_record(reader, whole, kWholeFields, numbers);
  reader.finish();
  return whole;
}

TEST(JsonFields, AreWrittenInOrderAndReadBack) {
  const Whole whole{
      0.5,     std::nullopt,           7, {}, {{"a", 1}, {"b", 3}}, {{"x", 2}}, model::Verdict::no,
      {-1, 1}, numbers::Matrix{{1, 2}}};
  const Json json = record_json(whole, kWholeFields);
  EXPECT_EQ(json.dump(),
            R"({"value":0.5,"bound":null,"runs":7,"parts":[{"name":"a"},{"name":"b","weight":3}],)"
            R"("named":{"x":2.0},"verdict":"no","ends":[18446744073709551615,1],"M":[[1.0,2.0]]})");
  const Whole again = whole_of(json.dump());
  EXPECT_EQ(record_json(again, kWholeFields), json);
  EXPECT_EQ(again.ends[0], -1);
  EXPECT_EQ(again.parts.at(0).weight, 1);
}

TEST(JsonFields, NameWhatIsWrong) {
  const std::string rest = R"("parts": [], "named": {}, "verdict": "no", "ends": [1, 2])";
  const auto message = [&](const std::string& text) {
    return input_error([&] { whole_of(text); }).message();
  };
  EXPECT_EQ(message(R"({"value": 1, )" + rest + "}"), "the key 'bound' is missing");
  EXPECT_EQ(message(R"({"value": "inf", "bound": 1, )" + rest + "}"), "value: expected a number");
  EXPECT_EQ(message(R"({"value": 1, "bound": 1, "more": 2, )" + rest + "}"),
            "unknown key 'more'; known: M, bound, ends, named, notes, parts, runs, value, verdict");
  EXPECT_EQ(message(R"({"value": 1, "bound": 1, "runs": null, )" + rest + "}"),
            "runs: expected a whole number from 0 on");
  EXPECT_EQ(message(R"({"value": 1, "bound": 1, "parts": [{"name": "a\n"}]})"),
            "parts[0].name: control characters are no part of this: 'a\\x0a'");
  EXPECT_EQ(message(R"({"value": 1, "bound": 1, "parts": [], "named": {}, "verdict": "maybe"})"),
            "verdict: expected yes, no or undecided");
  EXPECT_EQ(message(R"({"value": 1, "bound": 1, "parts": [], "named": {}, "verdict": "no",)"
                    R"( "ends": [1]})"),
            "ends: expected 2 elements");
}

TEST(JsonFields, NumbersWithoutASpellingAreNullOrTexts) {
  EXPECT_TRUE(number_json(kInfinity, JsonNumbers::or_null).is_null());
  EXPECT_EQ(number_json(-kInfinity, JsonNumbers::or_text), "-inf");
  EXPECT_EQ(number_json(-0.0, JsonNumbers::or_text), -0.0);
  for (const double value : {1.5, -0.0, kInfinity, -kInfinity, std::nan("")}) {
    const Json json = number_json(value, JsonNumbers::exact);
    const double back = number_of(JsonReader(json, "d.json"), JsonNumbers::exact);
    EXPECT_EQ(std::isnan(back), std::isnan(value));
    EXPECT_EQ(std::signbit(back), std::signbit(value));
    EXPECT_TRUE(back == value || std::isnan(value));
  }
  const Json nan = "nan";
  EXPECT_THROW(number_of(JsonReader(nan, "d.json"), JsonNumbers::or_text), InputError);
}

}  // namespace
}  // namespace gainsmith::io
