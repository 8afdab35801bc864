// What is searched: the largest or smallest scalar with a yes, or the best figure over scalars. The
// figure is an expression of the results, or one of simulated runs.
#include "io/yaml/search_yaml.h"

#include <cmath>

#include "io/yaml/figure_yaml.h"

namespace gainsmith::io {

namespace {

/// `largest` or `smallest`: one scalar.
std::optional<model::ScalarRange> extreme(const YamlFile& file, const std::optional<YamlItem>& item,
                                          const model::Method& method) {
  if (!item) return std::nullopt;
  const auto ranges = scalar_ranges(file, item, item->key, method);
  if (ranges.size() != 1)
    throw InputError(item->place,
                     item->key + ": expected one scalar and its range, such as {T2: [0.5, 1.1]}");
  return ranges.front();
}

/// From 1 to a million.
int whole_number(const YamlFile& file, const YamlItem& item) {
  constexpr double kMost = 1e6;
  const double value = file.number(item.value, item.key);
  if (!(value >= 1 && value <= kMost) || value != std::floor(value))
    throw InputError(file.place(item.value),
                     item.key + ": expected a whole number from 1 to 1000000");
  return static_cast<int>(value);
}

}  // namespace

model::ScalarRange scalar_range(const YamlFile& file, const YamlItem& item) {
  if (!item.value.IsSequence() || item.value.size() != 2)
    throw InputError(file.place(item.value), item.key + ": expected a range [low, high]");
  return {item.key, file.expression(item.value[0], item.key),
          file.expression(item.value[1], item.key), item.place};
}

std::vector<model::ScalarRange> scalar_ranges(const YamlFile& file,
                                              const std::optional<YamlItem>& item,
                                              const std::string& what,
                                              const model::Method& method) {
  std::vector<model::ScalarRange> ranges;
  for (const YamlItem& entry : items_of(file, item, what)) {
    model::check_scalar_name(method, entry.key, entry.place);
    ranges.push_back(scalar_range(file, entry));
  }
  return ranges;
}

model::Search search_from(const YamlFile& file, const YamlItem& item, const model::Method& method) {
  YamlMap map(file, item.value, "search", keys::search);
  model::Search search;
  search.place = item.place;
  const auto largest = map.find("largest");
  const auto smallest = map.find("smallest");
  const auto tolerance = map.find("tolerance");
  const auto over = map.find("over");
  const auto minimize = map.find("minimize");
  const auto runs = map.find("runs");
  const auto count = map.find("evaluations");
  map.finish();
  if (largest && smallest)
    throw InputError(smallest->place, "search: either 'largest' or 'smallest', not both");
  search.largest = !smallest;
  search.extreme = extreme(file, largest ? largest : smallest, method);
  search.over = scalar_ranges(file, over, "over", method);
  if (!search.extreme && search.over.empty())
    throw InputError(item.place, "search: expected 'largest', 'smallest' or 'over'");
  if (minimize && search.extreme)
    throw InputError(minimize->place, "search: '" + (largest ? largest : smallest)->key +
                                          "' is the figure already; leave out 'minimize'");
  if (tolerance && !search.extreme)
    throw InputError(tolerance->place, "search: 'tolerance' belongs to 'largest' or 'smallest'");
  if (count && search.over.empty())
    throw InputError(count->place, "search: 'evaluations' belongs to 'over'");
  if (tolerance) search.tolerance = file.positive(tolerance->value, "tolerance");
  // A mapping is a figure of simulated runs, a text an expression of the results.
  const bool of_runs = minimize && minimize->value.IsMap();
  if (of_runs) search.run_figure = figure_of(file, *minimize);
  if (minimize && !of_runs) search.minimize = file.expression(minimize->value, "minimize");
  if (runs && !of_runs)
    throw InputError(runs->place,
                     "search: 'runs' belongs to a figure of runs, such as minimize: {rms: e, over: "
                     "[0, 20]}");
  if (runs) search.runs = static_cast<std::uint64_t>(whole_number(file, *runs));
  if (count) search.evaluations = whole_number(file, *count);
  return search;
}

}  // namespace gainsmith::io
