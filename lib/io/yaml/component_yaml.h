// Internal to io: one plant or observer, and its events.
#pragma once

#include <string>
#include <vector>

#include "io/yaml/yaml.h"
#include "model/component.h"
#include "model/measured.h"

namespace gainsmith::io {

/// The component of a key "plant", "observer" or of one of several; `before`: those that it may be
/// `like`. `measured`: of a plant, which may be a log.
model::Component component(const YamlFile& file, const YamlItem& item,
                           const std::vector<model::Component>& before,
                           std::vector<model::MeasuredText>* measured = nullptr);

/// One event: "far: {when: norm(xh) >= 3}".
model::EventText event(const YamlFile& file, const YamlItem& item);

/// The events of a mapping.
std::vector<model::EventText> events(const YamlFile& file, const std::optional<YamlItem>& item,
                                     const std::string& what);

/// One expression, or the two of a list [low, high].
std::vector<expr::Expression> one_or_two(const YamlFile& file, const YamlItem& item);

/// `normal` or `lognormal` of a mapping.
struct Spread {
  bool is_normal = true;
  /// The center, `mean` or `median` where the text says none, then the deviation or covariance.
  std::vector<model::Value> values;
  bool covariance = false;
};
/// None: the mapping has neither. Flat lists are columns.
std::optional<Spread> spread(const YamlFile& file, YamlMap& map, const std::string& mean,
                             const std::string& median);

}  // namespace gainsmith::io
