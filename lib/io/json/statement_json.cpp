#include "io/json/statement_json.h"

namespace gainsmith::io {

namespace {

/// A matrix of a data file with its decimals; one that was a list stays a list.
Json stated_matrix_json(const model::StatedMatrix& matrix) {
  Json rows = Json::array();
  auto element = matrix.elements.begin();
  for (int i = 0; i < matrix.rows; ++i) {
    Json row = Json::array();
    for (int j = 0; j < matrix.cols; ++j) row.push_back(decimal_json(*element++));
    if (matrix.flat) return row;
    rows.push_back(std::move(row));
  }
  return rows;
}

/// A file that the problem names: its hash, and its text or its matrices.
Json stated_file_json(const model::StatedFile& file) {
  Json result = {{"file", file.name}, {"sha256", file.sha256}};
  if (!file.text.empty()) result["text"] = file.text;
  for (const model::StatedMatrix& matrix : file.matrices)
    if (matrix.key.empty())
      result["matrix"] = stated_matrix_json(matrix);
    else
      result["matrices"][matrix.key] = stated_matrix_json(matrix);
  return result;
}

/// A list of numbers is one row that is marked as flat; otherwise all rows have one length.
model::StatedMatrix stated_matrix_of(const std::string& key, const JsonReader& reader) {
  const std::vector<JsonReader> rows = reader.items();
  const bool flat = rows.empty() || !rows.front().is_list();
  const std::size_t cols = flat ? rows.size() : rows.front().items().size();
  model::StatedMatrix matrix{
      key, flat ? 1 : static_cast<int>(rows.size()), static_cast<int>(cols), {}, flat};
  const auto add = [&](const std::vector<JsonReader>& row, const JsonReader& place) {
    if (row.size() != cols) place.fail("a row of another length");
    for (const JsonReader& element : row) matrix.elements.push_back(element.decimal());
  };
  if (flat) add(rows, reader);
  for (const JsonReader& row : rows)
    if (!flat) add(row.items(), row);
  if (matrix.elements.empty()) reader.fail("this matrix has no elements");
  return matrix;
}

model::StatedFile stated_file_of(const JsonReader& reader) {
  model::StatedFile file{reader.at("file").text(), reader.at("sha256").text(), "", {}};
  if (reader.has("text")) file.text = reader.at("text").source();
  if (reader.has("matrix")) file.matrices.push_back(stated_matrix_of("", reader.at("matrix")));
  if (reader.has("matrices"))
    for (const auto& [key, item] : reader.at("matrices").members())
      file.matrices.push_back(stated_matrix_of(key, item));
  return file;
}

}  // namespace

Json statement_json(const model::Statement& statement) {
  Json result = {{"method", statement.method_name},
                 {"method_text", statement.method_text},
                 {"problem_file", statement.problem_file},
                 {"problem_text", statement.problem_text}};
  for (const model::Setting& setting : statement.settings)
    result["set"][setting.name] = setting.value;
  if (!statement.files.empty()) result["files"] = list_json(statement.files, stated_file_json);
  result["sha256"] = statement.hash;
  return result;
}

model::Statement statement_of(const JsonReader& reader) {
  model::Statement statement{reader.at("method").text(""),
                             reader.at("method_text").source(),
                             reader.at("problem_file").text(),
                             reader.at("problem_text").source(),
                             reader.at("sha256").text(),
                             {},
                             {}};
  if (reader.has("set"))
    for (const auto& [name, value] : reader.at("set").members())
      statement.settings.push_back({name, value.text()});
  if (reader.has("files"))
    for (const JsonReader& item : reader.at("files").items())
      statement.files.push_back(stated_file_of(item));
  if (model::statement_hash(statement) != statement.hash)
    reader.fail("the method, problem or data do not match their sha256: the file was edited");
  return statement;
}

}  // namespace gainsmith::io
