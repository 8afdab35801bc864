// What a problem expects of its results: words, values with a tolerance or bounds, figures of a
// run.
#include "io/yaml/expectation_yaml.h"

#include <algorithm>

#include "base/nearest.h"
#include "expr/text/parser.h"
#include "io/yaml/figure_yaml.h"

namespace gainsmith::io {

namespace {

/// One of the known words. InputError for another one, with the nearest.
std::optional<std::string> word(const YamlFile& file, const std::optional<YamlItem>& item,
                                const std::vector<std::string>& known) {
  if (!item) return std::nullopt;
  std::string text = file.string(item->value, item->key);
  if (std::find(known.begin(), known.end(), text) == known.end())
    throw InputError(file.place(item->value),
                     item->key + ": unknown word '" + text + "'" + suggestion(text, known));
  return text;
}

model::ExpectedValue expected_value(const YamlFile& file, const YamlItem& item) {
  YamlMap map(file, item.value, item.key, keys::expected_value);
  model::ExpectedValue result;
  result.name = item.key;
  result.what = expr::parse(item.key_text);
  const auto read = [&](const char* key, std::optional<model::Value>& to) {
    if (const auto found = map.find(key)) to = value_of(file, *found);
  };
  read("value", result.value);
  read("below", result.below);
  read("above", result.above);
  result.relative = tolerance(file, map.find("relative"));
  result.absolute = tolerance(file, map.find("absolute"));
  result.place = item.place;
  map.finish();
  if (!result.value && !result.below && !result.above)
    throw InputError(item.place, item.key + ": expected a 'value' with its tolerance, 'relative' or "
                                            "'absolute'; or a bound, 'below' or 'above'");
  // A value needs a tolerance, and a bound takes none.
  const bool tolerated = result.relative || result.absolute;
  if (result.value && !tolerated)
    throw InputError(item.place, item.key + ": expected a tolerance, 'relative' or 'absolute'");
  if (!result.value && tolerated)
    throw InputError(item.place, item.key + ": a tolerance is of a 'value'; bounds have none");
  return result;
}

}  // namespace

std::optional<double> tolerance(const YamlFile& file, const std::optional<YamlItem>& item) {
  if (!item) return std::nullopt;
  const double value = file.number(item->value, item->key);
  if (value < 0)
    throw InputError(file.place(item->value), item->key + ": a tolerance must not be negative");
  return value;
}

model::Expectation expectation_from(const YamlFile& file, const YamlItem& item) {
  YamlMap map(file, item.value, "expect", keys::expectation);
  model::Expectation result;
  result.place = item.place;
  result.verdict = word(file, map.find("verdict"), {"yes", "no", "undecided"});
  result.status =
      word(file, map.find("status"), {"optimal", "feasible", "infeasible", "undecided"});
  result.campaign = word(file, map.find("campaign"), {"held", "violated", "undecided"});
  if (const auto bounds = map.find("active_bounds")) {
    if (!bounds->value.IsSequence())
      throw InputError(file.place(bounds->value),
                       "active_bounds: expected a list, such as [\"inv(P2)*X\"]");
    result.active_bounds.emplace();
    for (const auto& entry : bounds->value)
      result.active_bounds->push_back(file.string(entry, "active_bounds"));
  }
  for (const YamlItem& entry : items_of(file, map.find("values"), "values"))
    result.values.push_back(expected_value(file, entry));
  if (const auto run = map.find("run")) result.run = expected_figures(file, *run);
  map.finish();
  return result;
}

}  // namespace gainsmith::io
