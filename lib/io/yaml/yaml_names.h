// Internal to io: names in what replaces something, in a component or a problem that is `like`
// another.
#pragma once

#include <yaml-cpp/yaml.h>

#include <string>

namespace gainsmith::io {

/// "none" marks what is taken away.
bool is_none(const YAML::Node& node);

/// Whether the name occurs as a whole word in a text below the node: in a value, not in a key. "x"
/// does not occur in "x1" or "p.x".
bool is_read(const YAML::Node& node, const std::string& name);

}  // namespace gainsmith::io
