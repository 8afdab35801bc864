#include "io/json/sums_of_squares_json.h"

namespace gainsmith::io {

namespace {

using Record = model::SumOfSquaresRecord;

std::vector<std::string> texts_of(const JsonReader& reader) {
  std::vector<std::string> texts;
  for (const JsonReader& item : reader.items()) texts.push_back(item.text(""));
  return texts;
}

}  // namespace

Json sum_of_squares_json(const Record& record) {
  Json result = {
      {"name", record.name}, {"variables", record.variables}, {"squares", Json::array()}};
  for (const Record::Square& square : record.squares)
    result["squares"].push_back(
        {{"times", square.times}, {"basis", square.basis}, {"gram", square.gram}});
  for (const Record::Free& free : record.free)
    result["free"].push_back({{"times", free.times}, {"polynomial", free.polynomial}});
  return result;
}

Record sum_of_squares_of(const JsonReader& reader) {
  Record record{reader.at("name").text(""), texts_of(reader.at("variables")), {}, {}};
  for (const JsonReader& item : reader.at("squares").items()) {
    record.squares.push_back({item.at("times").whole(), texts_of(item.at("basis")), {}});
    for (const JsonReader& row : item.at("gram").items())
      record.squares.back().gram.push_back(texts_of(row));
  }
  if (reader.has("free"))
    for (const JsonReader& item : reader.at("free").items())
      record.free.push_back({item.at("times").whole(), item.at("polynomial").text("")});
  return record;
}

}  // namespace gainsmith::io
