#include "io/yaml/yaml_names.h"

#include <algorithm>
#include <cctype>

namespace gainsmith::io {

bool is_none(const YAML::Node& node) { return node.IsScalar() && node.Scalar() == "none"; }

bool is_read(const YAML::Node& node, const std::string& name) {
  if (node.IsMap() || node.IsSequence())
    return std::any_of(node.begin(), node.end(), [&](const auto& entry) {
      return is_read(node.IsMap() ? YAML::Node(entry.second) : YAML::Node(entry), name);
    });
  if (!node.IsScalar()) return false;
  const std::string& text = node.Scalar();
  const auto is_part = [&](std::size_t at) {
    return at < text.size() && (std::isalnum(static_cast<unsigned char>(text[at])) != 0 ||
                                text[at] == '_' || text[at] == '.');
  };
  for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + 1))
    if (!is_part(at - 1) && !is_part(at + name.size())) return true;
  return false;
}

}  // namespace gainsmith::io
