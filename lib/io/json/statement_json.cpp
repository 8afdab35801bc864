#include "io/json/statement_json.h"

#include "io/json/json_fields.h"

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

/// The matrix of a file that holds only one has no name.
void matrices_fields(FieldWriter& at, const std::vector<model::StatedMatrix>& matrices) {
  for (const model::StatedMatrix& matrix : matrices)
    (matrix.key.empty() ? at.object()["matrix"] : at.object()["matrices"][matrix.key]) =
        stated_matrix_json(matrix);
}

void matrices_fields(FieldReader& at, std::vector<model::StatedMatrix>& matrices) {
  if (at.has("matrix")) matrices.push_back(stated_matrix_of("", at.reader().at("matrix")));
  if (at.has("matrices"))
    for (const auto& [key, item] : at.reader().at("matrices").members())
      matrices.push_back(stated_matrix_of(key, item));
}

/// A file that the problem names: its hash, and its text or its matrices.
constexpr auto kStatedFileFields = [](auto& at, auto& file) {
  at("file", file.name);
  at("sha256", file.sha256);
  if (kReads<decltype(at)> ? at.has("text") : !file.text.empty()) at.source("text", file.text);
  matrices_fields(at, file.matrices);
};

constexpr auto kStatementFields = [](auto& at, auto& statement) {
  at.name("method", statement.method_name);
  at.source("method_text", statement.method_text);
  at("problem_file", statement.problem_file);
  at.source("problem_text", statement.problem_text);
  at.by_name("set", statement.settings, &model::Setting::name, &model::Setting::value);
  at.some("files", statement.files, kStatedFileFields);
  at("sha256", statement.hash);
};

}  // namespace

Json statement_json(const model::Statement& statement) {
  return record_json(statement, kStatementFields);
}

model::Statement statement_of(const JsonReader& reader) {
  model::Statement statement;
  read_record(reader, statement, kStatementFields);
  if (model::statement_hash(statement) != statement.hash)
    reader.fail("the method, problem or data do not match their sha256: the file was edited");
  return statement;
}

}  // namespace gainsmith::io
