// Mappings: keys that are asked for, and those that nobody knows.
#include <algorithm>
#include <utility>

#include "base/nearest.h"
#include "base/utf8.h"
#include "io/yaml/yaml.h"

namespace gainsmith::io {

namespace {

/// The beginning of a text, to be shown in one line.
std::string shortened(const std::string& text) {
  constexpr std::size_t kMost = 40;
  const std::size_t end = std::min(text.find('\n'), kMost);
  if (text.size() <= end) return text;
  std::size_t at = end;
  while (at > 0 && is_continuation(text[at])) --at;
  return text.substr(0, at) + "...";
}

}  // namespace

YamlMap::YamlMap(const YamlFile& file, const YAML::Node& node, std::string what)
    : what_(std::move(what)), place_(file.place(node)) {
  if (!node.IsMap())
    throw InputError(place_, what_ + ": expected a mapping 'key: value', found " +
                                 (node.IsSequence() ? "a list"
                                  : node.IsNull()   ? "nothing"
                                                    : "'" + shortened(node.Scalar()) + "'"));
  for (const auto& entry : node) {
    const std::string key = file.string(entry.first, what_ + ": a key", "");
    const Place place = file.place(entry.first);
    for (const YamlItem& earlier : items_)
      if (earlier.key == key)
        throw InputError(place, what_ + ": the key '" + key + "' is given twice; first in line " +
                                    std::to_string(earlier.place.line));
    items_.push_back({key, file.scalar(entry.first, key), place, entry.second});
  }
}

YamlMap::YamlMap(const YamlFile& file, const YAML::Node& node, std::string what, const Level& level)
    : YamlMap(file, node, std::move(what)) {
  level_ = &level;
}

/// A key that is asked for is known, whether it is there or not.
std::optional<YamlItem> YamlMap::find(const std::string& key) {
  if (level_ != nullptr) require_known(*level_, key);
  if (std::find(asked_.begin(), asked_.end(), key) == asked_.end()) asked_.push_back(key);
  for (const YamlItem& item : items_)
    if (item.key == key) return item;
  return std::nullopt;
}

/// Where the key is missing, the error names a key here that is likely meant to be it.
YamlItem YamlMap::require(const std::string& key) {
  if (auto item = find(key)) return *item;
  // A misspelt or shortened key explains the missing one.
  constexpr std::size_t kShortest = 3;
  const auto is_short_for_it = [&](const std::string& word) {
    return word.size() >= kShortest && key.starts_with(word);
  };
  for (const YamlItem& item : items_)
    if (std::find(asked_.begin(), asked_.end(), item.key) == asked_.end() &&
        (nearest(item.key, {key}) || is_short_for_it(item.key)))
      throw InputError(item.place,
                       what_ + ": unknown key '" + item.key + "'; did you mean '" + key + "'?");
  std::string others;
  for (const YamlItem& item : items_)
    if (level_ != nullptr && level_->find(item.key) == nullptr)
      others += (others.empty() ? "" : ", ") + ("'" + item.key + "'");
  throw InputError(place_, what_ + ": the key '" + key + "' is missing" +
                               (others.empty() ? "" : "; unknown here: " + others));
}

void YamlMap::finish(const std::map<std::string, std::string>& advice) const {
  for (const YamlItem& item : items_) {
    if (std::find(asked_.begin(), asked_.end(), item.key) != asked_.end()) continue;
    const auto known = advice.find(item.key);
    throw InputError(item.place, what_ + ": unknown key '" + item.key + "'" +
                                     (known != advice.end() ? "; " + known->second
                                                            : suggestion(item.key, asked_)));
  }
}

std::vector<YamlItem> items_of(const YamlFile& file, const std::optional<YamlItem>& item,
                               const std::string& what) {
  if (!item || item->value.IsNull()) return {};
  return YamlMap(file, item->value, what).items();
}

}  // namespace gainsmith::io
