#include "io/json/json_reader.h"

#include <gtest/gtest.h>

#include <cmath>

#include "io/problem_text.h"

namespace gainsmith::io {
namespace {

using tests::input_error;

/// The message of the error that `read` throws on the document.
template <class Read>
std::string message_of(const std::string& text, Read read) {
  const Json document = Json::parse(text);
  const JsonReader reader(document, "d.json");
  const InputError error = input_error([&] { read(reader); });
  EXPECT_EQ(error.place(), Place{"d.json"});
  return error.message();
}

TEST(JsonReaderTest, AsksForKeysOfItsTablesAlone) {
  const Json document = Json::parse(R"({"margins": [{"name": "jump"}], "gains": {"L": 2}})");
  const JsonReader reader(document, "d.json", "", gain_file_levels());
  EXPECT_THROW(reader.has("gians"), std::logic_error);
  const JsonReader margin = reader.at("margins").items().at(0);
  EXPECT_EQ(margin.at("name").text(), "jump");
  EXPECT_FALSE(margin.has("holds"));
  EXPECT_THROW(margin.has("problem"), std::logic_error);
  // Names of the user's are in no table.
  EXPECT_TRUE(reader.at("gains").has("L"));
}

TEST(JsonReaderTest, ReadsWhatIsThere) {
  const Json document = Json::parse(
      R"({"a": {"b": [1, 2.5]}, "t": "x", "yes": true, "M": [[1, 2], [3, 4]], "s": 7, "n": null})");
  const JsonReader reader(document, "d.json");
  EXPECT_EQ(reader.at("a").at("b").items().at(1).number(), 2.5);
  EXPECT_EQ(reader.at("t").text(), "x");
  EXPECT_TRUE(reader.at("yes").truth());
  EXPECT_EQ(reader.at("s").whole(), 7);
  EXPECT_EQ(reader.at("s").matrix()(0, 0), 7);
  EXPECT_EQ(reader.at("M").matrix()(1, 0), 3);
  EXPECT_TRUE(reader.at("n").is_null());
  EXPECT_TRUE(std::isinf(reader.at("n").number_or_infinity()));
  EXPECT_FALSE(reader.has("missing"));
  reader.finish();
}

TEST(JsonReaderTest, ErrorsHaveTheirPath) {
  const std::string text = R"({"a": {"b": [1, "x"]}})";
  EXPECT_EQ(message_of(text, [](auto r) { r.at("a").at("b").items().at(1).number(); }),
            "a.b[1]: expected a number");
  EXPECT_EQ(message_of(text, [](auto r) { r.at("a").at("other"); }),
            "a: the key 'other' is missing");
  EXPECT_EQ(message_of(text, [](auto r) { r.at("a").at("b").at("c"); }), "a.b: expected an object");
  EXPECT_EQ(message_of("[]", [](auto r) { r.members(); }), "expected an object");
}

TEST(JsonReaderTest, AMissingKeyIsExplainedByAMisspeltOne) {
  EXPECT_EQ(message_of(R"({"reult": 1})", [](auto r) { r.at("result"); }),
            "unknown key 'reult'; did you mean 'result'?");
  // A key that has been asked for is no misspelling of another.
  EXPECT_EQ(message_of(R"({"reult": 1})",
                       [](auto r) {
                         r.at("reult");
                         r.at("result");
                       }),
            "the key 'result' is missing");
}

TEST(JsonReaderTest, FinishFindsWhatNobodyAskedFor) {
  EXPECT_EQ(message_of(R"({"list": [{"name": 1}, {"name": 2, "nam": 3}]})",
                       [](auto r) {
                         for (const JsonReader& item : r.at("list").items()) item.at("name");
                         r.finish();
                       }),
            "list[1]: unknown key 'nam'; did you mean 'name'?");
  EXPECT_EQ(message_of(R"({"a": 1, "zzzz": 2})",
                       [](auto r) {
                         r.at("a");
                         r.has("b");
                         r.finish();
                       }),
            "unknown key 'zzzz'; known: a, b");
}

TEST(JsonReaderTest, MembersHaveAnyKeys) {
  const Json document = Json::parse(R"({"gains": {"any": 1, "name": [[2]]}})");
  const JsonReader reader(document, "d.json");
  EXPECT_EQ(reader.at("gains").members().size(), 2U);
  reader.finish();
}

}  // namespace
}  // namespace gainsmith::io
