// What a figure's text is as XML.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gainsmith::test {

struct Element {
  std::string name;
  std::map<std::string, std::string> attributes;
  std::string text;  ///< up to its first child, entities resolved
};

/// The elements in the order of their starts. Nothing where the text is not one well-formed element
/// of XML 1.0 (start and end tags, attributes, the five entities; no comments or declarations) in
/// UTF-8.
std::optional<std::vector<Element>> read_xml(std::string_view text);

/// Whether an element of the name `text` has this text.
bool has_text(const std::vector<Element>& all, const std::string& text);

}  // namespace gainsmith::test
