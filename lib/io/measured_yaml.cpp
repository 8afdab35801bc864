#include "io/measured_yaml.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "base/nearest.h"
#include "base/number.h"
#include "expr/parser.h"
#include "io/csv_table.h"
#include "io/sources.h"

namespace gainsmith::io {

namespace {

using model::Between;

std::shared_ptr<const CsvTable> table_of(const YamlFile& file, const YamlItem& item) {
  const std::string name = file.named_by(item.value, file.string(item.value, item.key));
  Sources& sources = file.sources(item.value);
  std::string text = sources.log({name, item.key, file.place(item.value)});
  return std::make_shared<const CsvTable>(std::move(text), sources.path_of(name));
}

/// Which rows of which file, and when they are.
struct Source {
  std::shared_ptr<const CsvTable> table;
  std::string time = "t";
  Place time_place;
  double from = 0;
  std::vector<std::pair<std::size_t, std::string>> words;  ///< by column

  bool takes(std::size_t row) const {
    for (const auto& [column, word] : words)
      if (table->text(row, column) != word) return false;
    return true;
  }
};

/// InputError when no row has the word in that column.
void require_word(const CsvTable& table, const std::pair<std::size_t, std::string>& word,
                  const Place& place) {
  std::vector<std::string> there;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const std::string text = table.text(row, word.first);
    if (text == word.second) return;
    if (!text.empty() && std::find(there.begin(), there.end(), text) == there.end())
      there.push_back(text);
  }
  throw InputError(place, "rows: no row of " + table.path() + " says '" + word.second + "' there" +
                              suggestion(word.second, there));
}

/// `path`: the item with the name of the file; the rest is taken from `map`.
Source source(const YamlFile& file, const YamlItem& path, YamlMap& map) {
  Source result;
  result.table = table_of(file, path);
  result.time_place = path.place;
  if (const auto time = map.find("time")) {
    result.time = file.string(time->value, "time");
    result.time_place = file.place(time->value);
  }
  if (const auto from = map.find("from")) result.from = file.number(from->value, "from");
  for (const YamlItem& item : items_of(file, map.find("rows"), "rows")) {
    result.words.emplace_back(result.table->column(item.key, item.place),
                              file.string(item.value, item.key));
    require_word(*result.table, result.words.back(), file.place(item.value));
  }
  return result;
}

Between between(const YamlFile& file, YamlMap& map, Between otherwise) {
  const auto item = map.find("between");
  if (!item) return otherwise;
  const std::string word = file.string(item->value, "between");
  if (word == "hold") return Between::hold;
  if (word == "line") return Between::line;
  throw InputError(file.place(item->value),
                   "between: expected 'hold' or 'line', found '" + word + "'");
}

/// The column of a name; of a vector "x", which a table of a run shows as x1, x2, ..., all of them.
std::vector<std::size_t> columns(const CsvTable& table, const std::string& name,
                                 const Place& place) {
  std::vector<std::size_t> found;
  if (const auto one = table.find(name)) return {*one};
  while (const auto next = table.find(name + std::to_string(found.size() + 1)))
    found.push_back(*next);
  if (found.empty()) return {table.column(name, place)};
  return found;
}

/// Whether the row has values; some of a vector alone are an error.
bool has_values(const CsvTable& table, std::size_t row, const std::vector<std::size_t>& columns) {
  std::size_t empty = 0;
  for (const std::size_t column : columns)
    if (table.text(row, column).empty()) ++empty;
  if (empty == 0 || empty == columns.size()) return empty == 0;
  throw InputError(table.place(row, columns.front()),
                   "the row has some elements of a vector and not the others");
}

double time_of(const Source& source, std::size_t row, std::size_t column, double before) {
  const auto time = source.table->number(row, column);
  const Place place = source.table->place(row, column);
  if (!time) throw InputError(place, "the row has no time");
  if (*time - source.from < before)
    throw InputError(place, "the time " + brief(*time, 15) + " comes after " +
                                brief(before + source.from, 15) +
                                ": rows must be in the order of time");
  return *time - source.from;
}

std::shared_ptr<const model::Series> series(const Source& source, const std::string& name,
                                            const Place& place) {
  const CsvTable& table = *source.table;
  const std::size_t time = table.column(source.time, source.time_place);
  const std::vector<std::size_t> of = columns(table, name, place);
  auto result = std::make_shared<model::Series>();
  result->file = table.path();
  std::vector<double> values;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (!source.takes(row) || !has_values(table, row, of)) continue;
    const double before = result->times.empty() ? -HUGE_VAL : result->times.back();
    result->times.push_back(time_of(source, row, time, before));
    for (const std::size_t column : of) values.push_back(*table.number(row, column));
  }
  if (result->times.empty())
    throw InputError(place, "no row of " + table.path() + " has a value of '" + name + "'");
  const auto count = static_cast<Eigen::Index>(of.size());
  result->values = numbers::Matrix(numbers::Matrix(values.size() / of.size(), count));
  for (Eigen::Index k = 0; k < result->values.rows(); ++k)
    for (Eigen::Index e = 0; e < count; ++e)
      result->values(k, e) = values[static_cast<std::size_t>(k * count + e)];
  return result;
}

/// "y: angle" or "y: {column: angle, between: line, at: sample}".
model::MeasuredText output(const YamlFile& file, const Source& source, const YamlItem& item,
                           Between otherwise) {
  model::MeasuredText result;
  result.name = item.key + ".log";
  result.output = true;
  result.place = item.place;
  result.between = otherwise;
  if (!item.value.IsMap()) {
    result.series = series(source, file.string(item.value, item.key), file.place(item.value));
    return result;
  }
  YamlMap map(file, item.value, item.key, keys::log_output);
  const YamlItem column = map.require("column");
  result.between = between(file, map, otherwise);
  if (const auto at = map.find("at")) result.at = file.string(at->value, "at");
  map.finish();
  if (!result.at.empty()) result.between = Between::hold;
  result.series = series(source, file.string(column.value, "column"), file.place(column.value));
  return result;
}

}  // namespace

bool is_measured(const YamlItem& input) { return input.value.IsMap(); }

model::MeasuredText measured_input(const YamlFile& file, const YamlItem& item) {
  YamlMap map(file, item.value, item.key, keys::measured_input);
  model::MeasuredText result;
  result.name = item.key;
  result.place = item.place;
  const YamlItem csv = map.require("csv");
  const YamlItem column = map.require("column");
  const Source rows = source(file, csv, map);
  result.between = between(file, map, Between::hold);
  map.finish();
  result.series = series(rows, file.string(column.value, "column"), file.place(column.value));
  return result;
}

std::vector<double> measured_times(const YamlFile& file, const YamlItem& at) {
  YamlMap map(file, at.value, at.key, keys::measured_times);
  const YamlItem csv = map.require("csv");
  const YamlItem column = map.require("column");
  const Source rows = source(file, csv, map);
  map.finish();
  const std::size_t time =
      rows.table->column(file.string(column.value, "column"), file.place(column.value));
  std::vector<double> times;
  double before = -HUGE_VAL;
  for (std::size_t row = 0; row < rows.table->rows(); ++row) {
    if (!rows.takes(row) || !rows.table->number(row, time)) continue;
    before = time_of(rows, row, time, before);
    if (before >= 0) times.push_back(before);
  }
  if (times.empty())
    throw InputError(at.place, "at: no row of " + rows.table->path() + " has a time from 0 on");
  return times;
}

void read_log(const YamlFile& file, YamlMap& plant, model::Component& component,
              std::vector<model::MeasuredText>& measured) {
  const YamlItem log = plant.require("log");
  const auto read = [&](const Source& rows, Between otherwise) {
    for (const YamlItem& item : items_of(file, plant.find("output"), "plant.output")) {
      measured.push_back(output(file, rows, item, otherwise));
      const model::MeasuredText& made = measured.back();
      component.outputs.push_back(
          {{item.key, expr::parse(expr::Text::generated(made.name, item.place)), item.place},
           made.at});
    }
  };
  if (!log.value.IsMap()) {
    Source rows;
    rows.table = table_of(file, log);
    rows.time_place = log.place;
    read(rows, Between::hold);
    return;
  }
  YamlMap map(file, log.value, "log", keys::log);
  const Source rows = source(file, map.require("csv"), map);
  const Between otherwise = between(file, map, Between::hold);
  map.finish();
  read(rows, otherwise);
}

}  // namespace gainsmith::io
