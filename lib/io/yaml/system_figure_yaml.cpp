// Pictures of linear systems. The kind is the key that holds the systems; each kind may have a
// range and a scalar that is scanned.
#include "io/yaml/system_figure_yaml.h"

#include <fmt/ranges.h>

#include <ranges>

#include "base/nearest.h"
#include "io/yaml/search_yaml.h"

namespace gainsmith::io {

namespace {

using model::SystemPicture;

constexpr auto kKeys =
    std::views::transform(model::kSystemPictures, &model::SystemPictureKind::key);

/// A text, a list of them, or texts with labels.
std::vector<model::SystemFigureText::System> systems(const YamlFile& file, const YamlItem& item) {
  std::vector<model::SystemFigureText::System> found;
  const auto add = [&](const YAML::Node& node) {
    found.push_back({file.string(node, item.key), file.expression(node, item.key)});
  };
  if (item.value.IsMap()) {
    for (const YamlItem& entry : items_of(file, item, item.key))
      found.push_back({entry.key, file.expression(entry.value, entry.key)});
  } else if (item.value.IsSequence()) {
    for (const YAML::Node& node : item.value) add(node);
  } else {
    add(item.value);
  }
  if (found.empty())
    throw InputError(file.place(item.value),
                     item.key + ": expected a system, such as tf(1, [1, 2])");
  return found;
}

}  // namespace

model::SystemFigureText system_figure(const YamlFile& file, const YamlItem& item) {
  YamlMap map(file, item.value, "figures: " + item.key, keys::system_figure);
  model::SystemFigureText figure;
  figure.name = item.key;
  figure.place = item.place;
  // Each kind of picture is a key.
  std::optional<YamlItem> chosen;
  for (const model::SystemPictureKind& kind : model::kSystemPictures) {
    const auto found = map.find(std::string(kind.key));
    if (!found) continue;
    if (chosen)
      throw InputError(found->place, "figures: " + item.key + ": either '" + chosen->key +
                                         "' or '" + found->key + "': two pictures have two names");
    chosen = found;
    figure.kind = kind.kind;
    figure.systems = systems(file, *found);
  }
  const auto over = map.find("over"), scan = map.find("scan"), title = map.find("title");
  map.finish();
  if (!chosen)
    throw InputError(item.place, fmt::format("figures: {}: expected one of {}, with its system",
                                             item.key, fmt::join(kKeys, ", ")));
  if (title) figure.title = file.string(title->value, title->key);
  if (scan) {
    const std::vector<YamlItem> scalars = items_of(file, *scan, "scan");
    if (scalars.size() != 1)
      throw InputError(scan->place, "scan: expected one scalar, such as {r: [0.1, 10]}");
    figure.scan = scalar_range(file, scalars.front());
  }
  if (figure.kind == SystemPicture::margins && !scan)
    throw InputError(item.place, "figures: " + item.key +
                                     ": margins are drawn over a scalar: scan: {r: [0.1, 10]}");
  if (!over) return figure;
  if (kind_of(figure.kind).over == model::PictureRange::none)
    throw InputError(over->place,
                     "figures: " + item.key + ": " + to_string(figure.kind) + " have no range");
  if (!over->value.IsSequence() || over->value.size() != 2)
    throw InputError(file.place(over->value), "over: expected a range [low, high]");
  figure.over = {file.expression(over->value[0], "over"), file.expression(over->value[1], "over")};
  return figure;
}

}  // namespace gainsmith::io
