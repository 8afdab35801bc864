// Plants and observers. A component that is `like` an earlier one starts as its copy: own entries
// replace those of their names, `none` removes, the rest is added behind.
#include "io/yaml/component_yaml.h"

#include <algorithm>
#include <set>
#include <utility>

#include "base/nearest.h"
#include "io/yaml/data_file_yaml.h"
#include "io/yaml/declaration_yaml.h"
#include "io/yaml/measured_yaml.h"
#include "io/yaml/yaml_names.h"

namespace gainsmith::io {

namespace {

using model::Component;

/// The names of a mapping whose value is `none`.
using Removed = std::set<std::string>;

/// The items of a mapping; of a component that is `like` another without those that are `none`,
/// whose names go to `removed`.
std::vector<YamlItem> items_without(const YamlFile& file, const std::optional<YamlItem>& item,
                                    const std::string& what, bool like, Removed& removed) {
  // A YAML::Node that is assigned to changes what it referred to: items are copied, never moved.
  std::vector<YamlItem> items;
  for (const YamlItem& entry : items_of(file, item, what))
    if (like && is_none(entry.value))
      removed.insert(entry.key);
    else
      items.push_back(entry);
  return items;
}

std::string name_of(const model::Let& let) { return let.signature.name; }
std::string name_of(const model::ReactionText& reaction) { return reaction.event; }
template <class Entry>
std::string name_of(const Entry& entry) {
  return entry.name;
}

/// What is in `own` replaces what has its name; the rest comes after.
template <class Entry>
void overlay(std::vector<Entry>& copied, std::vector<Entry> own, const Removed& removed) {
  std::erase_if(copied, [&](const Entry& entry) { return removed.contains(name_of(entry)); });
  for (Entry& entry : own) {
    const auto found = std::find_if(copied.begin(), copied.end(), [&](const Entry& old) {
      return name_of(old) == name_of(entry);
    });
    if (found == copied.end())
      copied.push_back(std::move(entry));
    else
      *found = std::move(entry);
  }
}

/// "q: 1": where it starts.
model::Declaration mode(const YamlFile& file, const YamlItem& item) {
  model::Declaration result;
  result.name = item.key;
  result.place = item.place;
  result.shape = model::parse_shape(expr::Text::generated("scalar", item.place));
  result.fallback = file.expression(item.value, item.key);
  return result;
}

/// "y: C*x" or "y: {value: C*x + w, at: sample}".
model::Output output(const YamlFile& file, const YamlItem& item) {
  if (!item.value.IsMap()) return {{item.key, matrix_of(file, item), item.place}};
  YamlMap map(file, item.value, item.key, keys::output);
  model::Output result{{item.key, matrix_of(file, map.require("value")), item.place}};
  if (const auto at = map.find("at")) result.at = file.string(at->value, "at");
  map.finish();
  return result;
}

/// "K: ...", "K(i): ...": signatures with their bodies.
std::vector<model::Let> definitions(const YamlFile& file, const std::vector<YamlItem>& items) {
  std::vector<model::Let> result;
  for (const YamlItem& item : items)
    result.push_back(
        {expr::parse_signature(item.key_text), file.expression(item.value, item.key), item.place});
  return result;
}

/// The rate or the new value of a state, where a list of numbers is a column.
model::Named assignment(const YamlFile& file, const YamlItem& item) {
  return {item.key, matrix_of(file, item), item.place};
}

/// "{let: {K: ...}, xh: ...}": definitions, and new values of states.
void read_map(const YamlFile& file, const YamlItem& item, const std::string& what,
              model::PassText& pass) {
  for (const YamlItem& entry : items_of(file, item, what)) {
    if (entry.key != "let") {
      pass.map.push_back(assignment(file, entry));
      continue;
    }
    for (model::Let& let : definitions(file, items_of(file, entry, "let"))) {
      for (const model::Let& known : pass.let)
        if (known.signature.name == let.signature.name)
          throw InputError(let.place, "'" + let.signature.name +
                                          "' is defined twice here; first in line " +
                                          std::to_string(known.place.line));
      pass.let.push_back(std::move(let));
    }
  }
}

/// "{xh: ...}" or "{repeat: {xh: ...}, until: c, at_most: N, else: go on}", both with `let`.
model::PassText pass(const YamlFile& file, const YamlItem& item) {
  model::PassText result;
  result.place = item.place;
  if (!item.value.IsMap() || !item.value["repeat"]) {
    read_map(file, item, item.key, result);
    return result;
  }
  YamlMap map(file, item.value, item.key, keys::loop);
  result.repeats = true;
  const YamlItem repeated = map.require("repeat");
  const auto let = map.find("let");
  const auto until = map.find("until");
  const auto at_most = map.find("at_most");
  const auto times = map.find("times");
  const auto otherwise = map.find("else");
  map.finish();
  if (let) result.let = definitions(file, items_of(file, let, "let"));
  read_map(file, repeated, "repeat", result);
  // `at_most` goes with `until`, `times` with neither.
  if (at_most.has_value() == times.has_value() || until.has_value() != at_most.has_value())
    throw InputError(item.place,
                     "a loop is {repeat: map, until: condition, at_most: N} or {repeat: map, "
                     "times: N}");
  if (until) result.until = file.expression(until->value, "until");
  result.at_most =
      at_most ? file.expression(at_most->value, "at_most") : file.expression(times->value, "times");
  if (!otherwise) return result;
  const std::string word = file.string(otherwise->value, "else");
  if (word != "go on" || !until)
    throw InputError(file.place(otherwise->value),
                     "else: 'go on', after 'until', is all that is allowed here; without it the "
                     "run ends when the condition does not become true");
  result.go_on = true;
  return result;
}

/// A map or a list of maps.
model::ReactionText reaction(const YamlFile& file, const YamlItem& item) {
  model::ReactionText result;
  result.event = item.key;
  result.place = item.place;
  if (!item.value.IsSequence()) {
    result.passes.push_back(pass(file, item));
    return result;
  }
  for (const auto& entry : item.value)
    result.passes.push_back(pass(file, {item.key, item.key_text, file.place(entry), entry}));
  return result;
}

/// "while: {c: condition, say: text}": where it may flow, and what is said of a run that leaves it.
std::vector<model::FlowSetText> flow_sets(const YamlFile& file,
                                          const std::optional<YamlItem>& item) {
  std::vector<model::FlowSetText> result;
  if (!item) return result;
  YamlMap map(file, item->value, "while", keys::flow_set);
  model::FlowSetText flow_set;
  flow_set.place = item->place;
  flow_set.condition = file.expression(map.require("c").value, "c");
  flow_set.say = file.string(map.require("say").value, "say");
  map.finish();
  result.push_back(std::move(flow_set));
  return result;
}

/// A plant that is a log.
Component logged(const YamlFile& file, const YamlItem& item, YamlMap& map,
                 std::vector<model::MeasuredText>& measured) {
  Component result;
  result.name = item.key;
  result.place = item.place;
  read_log(file, map, result, measured);
  result.events = events(file, map.find("events"), item.key + ".events");
  std::map<std::string, std::string> advice;
  for (const char* key : {"state", "mode", "let", "flow", "at", "jump", "frozen", "while"})
    advice[key] = "a plant that is a log has outputs and events, and nothing else";
  map.finish(advice);
  return result;
}

/// InputError for a definition that takes the place of none, is read by nothing, and is likely to
/// be a misspelling.
void require_replacing(const YamlFile& file, const YamlItem& item, const YamlItem& like,
                       const std::vector<model::Let>& known, const std::vector<model::Let>& own) {
  std::vector<std::string> names;
  for (const model::Let& let : known) names.push_back(let.signature.name);
  for (const model::Let& let : own) {
    const std::string& name = let.signature.name;
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;
    if (is_read(item.value, name)) continue;
    if (const auto near = nearest(name, names))
      throw InputError(let.place, "'" + name + "' is no definition of " +
                                      file.string(like.value, "like") +
                                      ", and nothing reads it; did you mean '" + *near + "'?");
  }
}

/// The component that this one is `like`, which precedes it; an empty one without `like`.
Component copied(const YamlFile& file, const std::optional<YamlItem>& like,
                 const std::vector<Component>& before) {
  if (!like) return {};
  const std::string name = file.string(like->value, "like");
  std::vector<std::string> names;
  for (const Component& one : before) {
    if (one.name == name) return one;
    names.push_back(one.name);
  }
  throw InputError(file.place(like->value), "like: there is no observer '" + name +
                                                "' before this one" + suggestion(name, names));
}

}  // namespace

/// Sections in the order of the tables. Each replaces entries of the copy that `like` made.
Component component(const YamlFile& file, const YamlItem& item,
                    const std::vector<Component>& before,
                    std::vector<model::MeasuredText>* measured) {
  const bool is_log = measured != nullptr && item.value.IsMap() && item.value["log"];
  YamlMap map(file, item.value, item.key, is_log ? keys::log_plant : keys::component);
  if (is_log) return logged(file, item, map, *measured);
  const auto source = map.find("like");
  const bool like = source.has_value();
  Component result = copied(file, source, before);
  result.name = item.key;
  result.place = item.place;
  if (const auto family = map.find("for")) result.indices = indices(file, family);
  // Reads one section: own entries over those of the copy, `none` removes.
  const auto read = [&](const char* key, auto& list, auto&& one) {
    Removed removed;
    std::vector<std::decay_t<decltype(list.front())>> own;
    for (const YamlItem& entry :
         items_without(file, map.find(key), item.key + "." + key, like, removed))
      own.push_back(one(file, entry));
    overlay(list, std::move(own), removed);
  };
  read("state", result.states, [](const YamlFile& from, const YamlItem& entry) {
    return declaration(from, entry, "start");
  });
  read("mode", result.modes, mode);
  read("output", result.outputs, output);
  read("let", result.let, [](const YamlFile& from, const YamlItem& entry) {
    return definitions(from, {entry}).front();
  });
  if (like && map.find("let"))
    require_replacing(file, item, *source, copied(file, source, before).let, result.let);
  read("flow", result.flow, assignment);
  read("jump", result.jump, assignment);
  read("at", result.at, reaction);
  read("events", result.events, event);
  if (const auto frozen = map.find("frozen"))
    result.frozen = file.expression(frozen->value, "frozen");
  if (const auto flow_set = map.find("while")) result.flow_sets = flow_sets(file, flow_set);
  map.finish();
  return result;
}

/// A value alone is the deviation; a mapping may have a center and a covariance.
std::optional<Spread> spread(const YamlFile& file, YamlMap& map, const std::string& mean,
                             const std::string& median) {
  const auto normal = map.find("normal");
  const auto lognormal = map.find("lognormal");
  if (!normal && !lognormal) return std::nullopt;
  const YamlItem& item = normal ? *normal : *lognormal;
  if (normal && lognormal) throw InputError(item.place, "either normal or lognormal, not both");
  const auto value = [&](const YamlItem& entry) {
    return model::Value{entry.key, matrix_of(file, entry), false, file.place(entry.value)};
  };
  const expr::Text otherwise = expr::Text::generated(normal ? mean : median, item.place);
  Spread said{normal.has_value(), {{item.key, expr::parse(otherwise), false, item.place}}};
  if (item.value.IsMap() && !names_file(item.value)) {
    YamlMap own(file, item.value, item.key, normal ? keys::normal : keys::lognormal);
    const auto center = own.find(normal ? "mean" : "median");
    const auto deviation = own.find("deviation");
    const auto covariance = own.find("covariance");
    own.finish();
    if (deviation.has_value() == covariance.has_value())
      throw InputError(item.place, item.key + ": expected a deviation or {covariance: V}");
    if (center) said.values.front() = value(*center);
    said.values.push_back(value(deviation ? *deviation : *covariance));
    said.covariance = covariance.has_value();
  } else {
    said.values.push_back(value(item));
  }
  return said;
}

}  // namespace gainsmith::io
