// The choices for the synthesis: the margin of strict inequalities, bounds on gains, how "for all"
// is met, and effort.
#include "io/yaml/synthesis_yaml.h"

#include <algorithm>
#include <string>
#include <vector>

#include "base/nearest.h"
#include "io/schema/keys.h"

namespace gainsmith::io {

namespace {

/// How inequalities for all values of a variable are met (docs/forall.md).
model::Way way_of(const YamlFile& file, const YamlItem& item) {
  using model::Way;
  std::vector<std::string> words;
  const std::string word = file.string(item.value, item.key);
  for (const Way way : {Way::automatic, Way::hull, Way::exchange, Way::vertex_gains}) {
    if (to_string(way) == word) return way;
    words.push_back(to_string(way));
  }
  throw InputError(file.place(item.value),
                   item.key + ": unknown way '" + word + "'" + suggestion(word, words));
}

/// "forall: hull" or "forall: {way: hull, slices: 4}".
void read_way(const YamlFile& file, const YamlItem& item, model::SynthesisOptions& options) {
  constexpr int kMostSlices = 10000;
  if (!item.value.IsMap()) {
    options.way = way_of(file, item);
    return;
  }
  YamlMap parts(file, item.value, "forall", keys::way);
  options.way = way_of(file, parts.require("way"));
  if (const auto slices = parts.find("slices")) {
    options.slices = static_cast<int>(whole(file, *slices, 1));
    if (options.slices > kMostSlices)
      throw InputError(file.place(slices->value), "slices: at most " + std::to_string(kMostSlices));
    if (options.way != model::Way::hull)
      throw InputError(file.place(slices->value), "slices: the way '" + to_string(options.way) +
                                                      "' has none, only 'hull' has");
  }
  parts.finish();
}

}  // namespace

std::uint64_t whole(const YamlFile& file, const YamlItem& item, double least) {
  constexpr double kMost = 1e15;
  const double value = file.number(item.value, item.key);
  if (!(value >= least && value <= kMost) ||
      value != static_cast<double>(static_cast<std::uint64_t>(value)))
    throw InputError(file.place(item.value), item.key + ": expected a whole number from " +
                                                 std::to_string(static_cast<int>(least)) +
                                                 " to 1e15");
  return static_cast<std::uint64_t>(value);
}

void set_margin(const YamlFile& file, const YamlItem& item, model::SynthesisOptions& options) {
  options.margin = file.positive(item.value, "margin");
  if (options.margin >= 1)
    throw InputError(file.place(item.value), "margin: relative to the data's scale, so below 1");
}

void set_gain_bound(const YamlFile& file, const YamlItem& item, model::SynthesisOptions& options) {
  // A later statement, such as one of the command line, replaces an earlier one as a whole.
  options.gain_bounds.clear();
  options.gain_bound_stated = true;
  options.gain_bound = std::nullopt;
  if (item.value.IsMap()) {
    for (const YamlItem& entry : items_of(file, item, "gain_bound")) {
      options.gain_bounds.push_back(
          {entry.key, file.positive(entry.value, entry.key), entry.place});
      options.gain_bound =
          std::max(options.gain_bound.value_or(0), options.gain_bounds.back().bound);
    }
    if (options.gain_bounds.empty())
      throw InputError(item.place, "gain_bound: a bound for one gain at least, or none");
    return;
  }
  if (!item.value.IsScalar())
    throw InputError(file.place(item.value),
                     "gain_bound: expected a number, {gain: number, ...} or none");
  for (const char* word : {"inf", ".inf", "Inf", "infinity"})
    if (item.value.Scalar() == word)
      throw InputError(file.place(item.value), "gain_bound: write none, for gains of any size");
  if (item.value.Scalar() != "none") options.gain_bound = file.positive(item.value, "gain_bound");
}

model::SynthesisOptions synthesis(const YamlFile& file, const std::optional<YamlItem>& item) {
  model::SynthesisOptions options;
  if (!item) return options;
  YamlMap map(file, item->value, "synthesis", keys::synthesis);
  if (const auto margin = map.find("margin")) set_margin(file, *margin, options);
  if (const auto bound = map.find("gain_bound")) set_gain_bound(file, *bound, options);
  if (const auto forall = map.find("forall")) read_way(file, *forall, options);
  if (const auto effort = map.find("effort")) {
    const std::vector<std::string> words = {"ordinary", "full"};
    const std::string word = file.string(effort->value, "effort");
    if (std::find(words.begin(), words.end(), word) == words.end())
      throw InputError(file.place(effort->value),
                       "effort: ordinary or full, not '" + word + "'" + suggestion(word, words));
    options.full_effort = word == "full";
  }
  map.finish();
  return options;
}

}  // namespace gainsmith::io
