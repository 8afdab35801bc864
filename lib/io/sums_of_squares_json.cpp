#include "io/sums_of_squares_json.h"

namespace gainsmith::io {

namespace {

using Record = model::SumOfSquaresRecord;

Json summand_json(const Record::Summand& summand) {
  return {{"c", summand.c}, {"row", summand.row}, {"exponents", summand.exponents}};
}

std::vector<int> exponents_of(const JsonReader& reader) {
  std::vector<int> exponents;
  for (const JsonReader& item : reader.items()) exponents.push_back(item.whole());
  return exponents;
}

Record::Summand summand_of(const JsonReader& reader) {
  return {reader.at("c").text(), reader.at("row").whole(), exponents_of(reader.at("exponents"))};
}

Record::Square square_of(const JsonReader& reader) {
  Record::Square square{reader.at("times").whole(), {}, {}};
  for (const JsonReader& polynomial : reader.at("basis").items()) {
    auto& summands = square.basis.emplace_back();
    for (const JsonReader& item : polynomial.items()) summands.push_back(summand_of(item));
  }
  for (const JsonReader& row : reader.at("gram").items()) {
    auto& texts = square.gram.emplace_back();
    for (const JsonReader& item : row.items()) texts.push_back(item.text());
  }
  return square;
}

}  // namespace

Json sum_of_squares_json(const Record& record) {
  Json squares = Json::array();
  for (const Record::Square& square : record.squares) {
    Json basis = Json::array();
    for (const auto& polynomial : square.basis) {
      basis.push_back(Json::array());
      for (const Record::Summand& summand : polynomial)
        basis.back().push_back(summand_json(summand));
    }
    squares.push_back(
        {{"times", square.times}, {"basis", std::move(basis)}, {"gram", square.gram}});
  }
  Json result = {
      {"name", record.name}, {"variables", record.variables}, {"squares", std::move(squares)}};
  for (const Record::Free& free : record.free) {
    Json item = summand_json(free.summand);
    item["times"] = free.times;
    item["column"] = free.column;
    result["free"].push_back(std::move(item));
  }
  return result;
}

Record sum_of_squares_of(const JsonReader& reader) {
  Record record{reader.at("name").text(""), {}, {}, {}};
  for (const JsonReader& item : reader.at("variables").items())
    record.variables.push_back(item.text(""));
  for (const JsonReader& item : reader.at("squares").items())
    record.squares.push_back(square_of(item));
  if (reader.has("free"))
    for (const JsonReader& item : reader.at("free").items())
      record.free.push_back(
          {item.at("times").whole(), item.at("column").whole(), summand_of(item)});
  return record;
}

Json moments_json(const std::vector<std::vector<model::MomentRecord>>& moments) {
  Json result = Json::array();
  for (const auto& list : moments) {
    Json items = Json::array();
    for (const model::MomentRecord& one : list)
      items.push_back({{"row", one.row},
                       {"column", one.column},
                       {"exponents", one.exponents},
                       {"value", one.value}});
    result.push_back(std::move(items));
  }
  return result;
}

std::vector<std::vector<model::MomentRecord>> moments_of(const JsonReader& reader) {
  std::vector<std::vector<model::MomentRecord>> result;
  for (const JsonReader& list : reader.items()) {
    auto& moments = result.emplace_back();
    for (const JsonReader& item : list.items())
      moments.push_back({item.at("row").whole(), item.at("column").whole(),
                         exponents_of(item.at("exponents")), item.at("value").text()});
  }
  return result;
}

}  // namespace gainsmith::io
