// Internal to io: what a person can do about a text that is no YAML.
#pragma once

#include <cstddef>
#include <string>

namespace gainsmith::io {

struct YamlError {
  std::size_t line = 0;    ///< from 0
  std::size_t column = 0;  ///< in bytes, from 0
  std::string message;
};

/// The reader's error, with the cure where its line shows one: a tab in the indentation, or a
/// formula that begins like something of YAML's own and must be quoted. Then the place is that of
/// the cause.
YamlError explained(const std::string& text, YamlError error);

}  // namespace gainsmith::io
