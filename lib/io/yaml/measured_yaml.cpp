// Measured data from logs. A series is a column, or the columns x1, x2, ... of a vector, over the
// times of its rows; rows must be in the order of time.
#include "io/yaml/measured_yaml.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

#include "base/nearest.h"
#include "base/number.h"
#include "expr/text/parser.h"
#include "io/matrix/csv_table.h"
#include "io/sources.h"
#include "io/yaml/log_times.h"

namespace gainsmith::io {

namespace {

using model::Between;

/// The table of the file that the item names, which a problem may name.
std::shared_ptr<const CsvTable> table_of(const YamlFile& file, const YamlItem& item) {
  const std::string name = file.named_by(item.value, file.string(item.value, item.key));
  Sources& sources = file.sources(item.value);
  std::string text = sources.log({name, item.key, file.place(item.value)});
  return std::make_shared<const CsvTable>(std::move(text), sources.path_of(name));
}

/// Which rows of which file, and when they are.
struct Source {
  std::shared_ptr<const CsvTable> table;
  std::shared_ptr<const LogTimes> times;
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

/// A unit of time; none of what is no such unit.
std::optional<double> seconds_of(const std::string& unit) {
  static const std::map<std::string, double> kUnits = {
      {"s", 1},          {"sec", 1},   {"ms", 1e-3}, {"msec", 1e-3}, {"us", 1e-6},
      {"\u00b5s", 1e-6}, {"ns", 1e-9}, {"min", 60},  {"h", 3600}};
  const auto found = kUnits.find(unit);
  return found == kUnits.end() ? std::nullopt : std::optional(found->second);
}

/// `path`: the item with the name of the file; the rest is taken from `map`, where there is one.
/// `time`: the item with the column of the times, instead of the key of that name.
Source source(const YamlFile& file, const YamlItem& path, YamlMap* map,
              std::optional<YamlItem> time = std::nullopt) {
  Source result;
  result.table = table_of(file, path);
  const auto find = [&](const char* key) { return map ? map->find(key) : std::nullopt; };
  const auto own = find("time");
  if (!time) time = own;
  // Without the key: the column t, or time where there is no t.
  const bool has_time = !result.table->find("t") && result.table->find("time");
  const std::size_t column =
      time ? result.table->column(file.string(time->value, time->key), file.place(time->value))
           : result.table->column(has_time ? "time" : "t", path.place);
  const auto scale = find("scale");
  const auto from = find("from");
  const std::string word = result.table->unit(column);
  const auto known = seconds_of(word);
  // A unit that is not known would be taken for seconds.
  if (!scale && !known && !word.empty() && word != "-" && result.table->rows() > 0 &&
      parse_decimal(result.table->text(0, column)))
    throw InputError(path.place, result.table->path() + ": the times are in '" + word +
                                     "', which is none of s, ms, us, ns, min, h; `scale: 1e-3` "
                                     "says that they are in units of 1e-3 s");
  const double unit = scale ? file.number(scale->value, "scale") : known.value_or(1);
  if (!(unit > 0)) throw InputError(file.place(scale->value), "scale: expected a positive number");
  result.times = std::make_shared<const LogTimes>(
      *result.table, column, unit,
      from ? std::optional(file.string(from->value, "from")) : std::nullopt,
      from ? file.place(from->value) : path.place);
  file.sources(path.value)
      .takes_unit(result.table->path() + ", column " + std::to_string(column + 1), unit,
                  scale ? file.place(scale->value) : path.place);
  if (from || result.times->begins_by_itself())
    file.sources(path.value).has_origin(result.table->path(), from.has_value(), path.place);
  for (const YamlItem& item : items_of(file, find("rows"), "rows")) {
    result.words.emplace_back(result.table->column(item.key, item.place),
                              file.string(item.value, item.key));
    require_word(*result.table, result.words.back(), file.place(item.value));
  }
  return result;
}

/// How values go on between rows: held, or on a line to the next one.
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

/// Whether a cell says that there is no value.
bool is_silent(const CsvTable& table, std::size_t row, std::size_t column) {
  std::string word = table.text(row, column);
  std::transform(word.begin(), word.end(), word.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return word.empty() || word == "nan" || word == "na" || word == "n/a" || word == "null";
}

/// Whether the row has values; some of a vector alone are an error.
bool has_values(const CsvTable& table, std::size_t row, const std::vector<std::size_t>& columns) {
  const auto silent = std::count_if(columns.begin(), columns.end(), [&](std::size_t column) {
    return is_silent(table, row, column);
  });
  if (silent == 0 || silent == std::ssize(columns)) return silent == 0;
  throw InputError(table.place(row, columns.front()),
                   "the row has some elements of a vector and not the others");
}

/// The time of a row, in seconds. InputError where there is none, and where it is below `before`.
double time_of(const Source& source, std::size_t row, double before) {
  const auto time = source.times->at(row);
  const Place place = source.times->place(row);
  if (!time) throw InputError(place, "the row has no time");
  if (*time < before)
    throw InputError(place, "the time " + brief(*time, 15) + " comes after " + brief(before, 15) +
                                ": rows must be in the order of time");
  return *time;
}

/// The rows that the source takes, n rows by the elements of the quantity. Times of rows without a
/// value are kept apart. InputError where no row has one.
std::shared_ptr<const model::Series> series(const Source& source, const std::string& name,
                                            const Place& place) {
  const CsvTable& table = *source.table;
  const std::vector<std::size_t> of = columns(table, name, place);
  auto result = std::make_shared<model::Series>();
  result->file = table.path();
  std::vector<double> values;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (!source.takes(row)) continue;
    const bool silent = !has_values(table, row, of);
    auto& times = silent ? result->silent : result->times;
    // Rows without values may have no time either.
    if (silent && !source.times->at(row)) continue;
    times.push_back(time_of(source, row, times.empty() ? -HUGE_VAL : times.back()));
    if (silent) continue;
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
  const Source rows = source(file, csv, &map);
  result.between = between(file, map, Between::hold);
  map.finish();
  result.series = series(rows, file.string(column.value, "column"), file.place(column.value));
  return result;
}

/// Times before that of the start of a run are left out.
std::vector<double> measured_times(const YamlFile& file, const YamlItem& at) {
  YamlMap map(file, at.value, at.key, keys::measured_times);
  const YamlItem csv = map.require("csv");
  const auto column = map.find("column");
  const Source rows = source(file, csv, &map, column);
  map.finish();
  std::vector<double> times;
  double before = -HUGE_VAL;
  for (std::size_t row = 0; row < rows.table->rows(); ++row) {
    if (!rows.takes(row) || !rows.times->at(row)) continue;
    before = time_of(rows, row, before);
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
    read(source(file, log, nullptr), Between::hold);
    return;
  }
  YamlMap map(file, log.value, "log", keys::log);
  const Source rows = source(file, map.require("csv"), &map);
  const Between otherwise = between(file, map, Between::hold);
  map.finish();
  read(rows, otherwise);
}

}  // namespace gainsmith::io
