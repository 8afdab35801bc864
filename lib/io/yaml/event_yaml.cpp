// Events: what they are due by, and what is asked of them besides.
#include <utility>

#include "io/yaml/component_yaml.h"
#include "io/yaml/measured_yaml.h"

namespace gainsmith::io {

namespace {

using EventKind = model::Dynamics::EventKind;

/// The keys that say what an event is due by.
const std::vector<std::pair<std::string, EventKind>>& kinds() {
  static const std::vector<std::pair<std::string, EventKind>> kKinds = {
      {"when", EventKind::when},       {"rises", EventKind::rises}, {"falls", EventKind::falls},
      {"crosses", EventKind::crosses}, {"every", EventKind::every}, {"at", EventKind::at}};
  return kKinds;
}

/// Of [0, 1): an event that is always lost never happens.
double probability(const YamlFile& file, const YamlItem& item) {
  const double value = file.number(item.value, item.key);
  if (value >= 0 && value < 1) return value;
  throw InputError(file.place(item.value), item.key + ": a probability, in [0, 1)");
}

/// "lost: 0.1" or "lost: {probability: 0.1, in_a_row: 2}".
void read_lost(const YamlFile& file, const YamlItem& item, model::EventText& event) {
  if (!item.value.IsMap()) {
    event.lost = probability(file, item);
    return;
  }
  YamlMap map(file, item.value, "lost", keys::lost);
  event.lost = probability(file, map.require("probability"));
  if (const auto most = map.find("in_a_row")) {
    const double value = file.number(most->value, most->key);
    if (!(value >= 1 && value <= 1e6 && value == static_cast<int>(value)))
      throw InputError(file.place(most->value), "in_a_row: a whole number, 1 or more");
    event.lost_in_a_row = static_cast<int>(value);
  }
  map.finish();
}

}  // namespace

/// All keys are taken before the first error, so that a misspelt one is named.
model::EventText event(const YamlFile& file, const YamlItem& item) {
  if (!item.value.IsMap())
    throw InputError(item.place, "the event '" + item.key +
                                     "': expected {when: condition}, {rises: e}, {falls: e}, "
                                     "{crosses: e}, {every: T} or {at: [t1, t2]}");
  YamlMap map(file, item.value, item.key, keys::event);
  model::EventText result;
  result.name = item.key;
  result.place = item.place;
  std::vector<std::pair<YamlItem, EventKind>> found;
  for (const auto& [key, kind] : kinds())
    if (const auto given = map.find(key)) found.emplace_back(*given, kind);
  const auto first = map.find("first");
  const auto only_if = map.find("if");
  const auto lost = map.find("lost");
  map.finish();
  if (found.size() != 1)
    throw InputError(item.place, "the event '" + item.key +
                                     "' needs one of when, rises, falls, crosses, every, at");
  const YamlItem& due = found.front().first;
  result.kind = found.front().second;
  if (result.kind == EventKind::every)
    result.numbers = one_or_two(file, due);
  else if (result.kind == EventKind::at && due.value.IsMap())
    result.rows = measured_times(file, due);
  else if (result.kind == EventKind::at && due.value.IsSequence())
    for (const auto& entry : due.value) result.numbers.push_back(file.expression(entry, "at"));
  else if (due.value.IsSequence())
    throw InputError(due.place, due.key + ": expected one expression, found a list");
  else if (result.kind == EventKind::at)
    result.numbers.push_back(file.expression(due.value, "at"));
  else
    result.what = file.expression(due.value, due.key);
  if (result.kind == EventKind::at && result.numbers.empty() && result.rows.empty())
    throw InputError(due.place, "at: expected a time at least");
  if (first && result.kind != EventKind::every)
    throw InputError(first->place, "first: only of an event with 'every'");
  if (first) result.first = one_or_two(file, *first);
  if (only_if) result.only_if = file.expression(only_if->value, "if");
  if (lost) read_lost(file, *lost, result);
  return result;
}

std::vector<expr::Expression> one_or_two(const YamlFile& file, const YamlItem& item) {
  if (!item.value.IsSequence()) return {file.expression(item.value, item.key)};
  if (item.value.size() != 2)
    throw InputError(file.place(item.value), item.key + ": expected a value or [low, high]");
  std::vector<expr::Expression> ends;
  for (const auto& end : item.value)
    ends.push_back(matrix_of(file, {item.key, item.key_text, file.place(end), end}));
  return ends;
}

std::vector<model::EventText> events(const YamlFile& file, const std::optional<YamlItem>& item,
                                     const std::string& what) {
  std::vector<model::EventText> result;
  for (const YamlItem& entry : items_of(file, item, what)) result.push_back(event(file, entry));
  return result;
}

}  // namespace gainsmith::io
