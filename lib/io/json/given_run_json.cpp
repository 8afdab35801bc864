#include "io/json/given_run_json.h"

#include <algorithm>
#include <vector>

#include "base/named.h"
#include "base/nearest.h"
#include "io/json/gains_json.h"
#include "io/json/json_reader.h"

namespace gainsmith::io {

namespace {

using hybrid::GivenRun;
using Names = std::vector<std::string>;

/// A column as a list, a number as itself, other matrices as lists of rows.
Json given_value_json(const numbers::Matrix& value) {
  if (value.cols() != 1) return matrix_json(value);
  if (value.size() == 1) return value(0, 0);
  Json column = Json::array();
  for (Eigen::Index i = 0; i < value.rows(); ++i) column.push_back(value(i, 0));
  return column;
}

/// The same read: a list of numbers is a column here, not a row.
numbers::Matrix given_value(const JsonReader& reader) {
  if (!reader.is_list()) return reader.matrix();
  const std::vector<JsonReader> items = reader.items();
  if (items.empty() || items.front().is_list()) return reader.matrix();
  numbers::Matrix column(items.size(), 1);
  for (std::size_t i = 0; i < items.size(); ++i)
    column(static_cast<Eigen::Index>(i), 0) = items[i].number();
  return column;
}

/// Those elements of a list that are given, by their names.
template <class List, class Write>
void add_given(Json& json, const std::string& key, const List& list, const Names& names,
               const Write& write) {
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Json value = write(list[i]);
    if (!value.is_null()) json[key][names[i]] = value;
  }
}

/// The list, or null for an empty one, which is not given.
template <class Item, class Write>
Json written_list(const std::vector<Item>& items, const Write& write) {
  if (items.empty()) return nullptr;
  Json list = Json::array();
  for (const Item& item : items) list.push_back(write(item));
  return list;
}

/// Puts the values under a key where their names are.
template <class List, class Read>
void take_given(const JsonReader& reader, const std::string& key, const Names& names, List& list,
                const Read& read) {
  if (!reader.has(key)) return;
  list.resize(names.size());
  for (const auto& [name, value] : reader.at(key).members()) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) value.fail("there is no '" + name + "'" + suggestion(name, names));
    list[static_cast<std::size_t>(found - names.begin())] = read(value);
  }
}

/// InputError for an empty list: it could not be used in turn.
template <class Item, class Read>
std::vector<Item> read_list(const JsonReader& reader, const Read& read) {
  std::vector<Item> list;
  for (const JsonReader& item : reader.items()) list.push_back(read(item));
  if (list.empty()) reader.fail("expected at least one element");
  return list;
}

}  // namespace

Json to_json(const GivenRun& run, const model::Dynamics& dynamics) {
  const Names events = names_of_all(dynamics.events);
  const auto number = [](double value) { return Json(value); };
  Json json = Json::object();
  add_given(json, "start", run.starts, names_of_all(dynamics.variables),
            [](const auto& start) { return start ? given_value_json(*start) : Json(nullptr); });
  add_given(json, "first", run.first, events,
            [](const auto& first) { return first ? Json(*first) : Json(nullptr); });
  add_given(json, "lengths", run.lengths, events,
            [&](const auto& lengths) { return written_list(lengths, number); });
  add_given(json, "lost", run.losses, events, [](const auto& losses) {
    return written_list(losses, [](char lost) { return Json(lost != 0); });
  });
  add_given(json, "noise", run.noise, names_of_all(dynamics.noise),
            [](const auto& values) { return written_list(values, given_value_json); });
  return json;
}

GivenRun parse_given_run(const std::string& text, const std::string& file,
                         const model::Dynamics& dynamics) {
  const Json document = parse_json(text, file);
  const JsonReader reader(document, file, text);
  if (!document.is_object()) reader.fail("expected an object");
  const Names events = names_of_all(dynamics.events);
  const auto number = [](const JsonReader& value) { return value.number(); };
  GivenRun run;
  run.place = {file};
  take_given(reader, "start", names_of_all(dynamics.variables), run.starts,
             [](const JsonReader& value) { return given_value(value); });
  take_given(reader, "first", events, run.first, number);
  take_given(reader, "lengths", events, run.lengths,
             [&](const JsonReader& list) { return read_list<double>(list, number); });
  take_given(reader, "lost", events, run.losses, [](const JsonReader& list) {
    return read_list<char>(
        list, [](const JsonReader& value) { return static_cast<char>(value.truth()); });
  });
  take_given(reader, "noise", names_of_all(dynamics.noise), run.noise,
             [](const JsonReader& list) { return read_list<numbers::Matrix>(list, given_value); });
  reader.finish();
  return run;
}

}  // namespace gainsmith::io
