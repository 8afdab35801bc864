#include "page/element.h"

#include <algorithm>

#include "drawing/text.h"

namespace gainsmith::page {

std::string element(std::string_view tag, std::string_view content, std::string_view attributes) {
  std::string text = "<";
  text += tag;
  if (!attributes.empty()) text.append(" ").append(attributes);
  text.append(">").append(content).append("</").append(tag).append(">");
  return text;
}

std::string text_element(std::string_view tag, std::string_view text, std::string_view attributes) {
  return element(tag, drawing::escaped(text), attributes);
}

/// Line by line: drawing::escaped() makes spaces of ends of lines.
std::string preformatted(std::string_view text, std::string_view attributes) {
  std::string lines;
  for (;;) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    lines += drawing::escaped(text.substr(0, end));
    if (end == text.size()) return element("pre", lines, attributes);
    lines += '\n';
    text.remove_prefix(end + 1);
  }
}

std::string headed_table(const std::vector<std::string_view>& heads, std::string_view rows) {
  std::string head;
  for (const std::string_view name : heads) head += text_element("th", name);
  std::string body;
  std::size_t column = 0;
  while (!rows.empty()) {
    const std::size_t end = std::min(rows.find("<t", 1), rows.size());  // the next row or cell
    std::string one(rows.substr(0, end));
    rows.remove_prefix(end);
    if (one.starts_with("<tr")) column = 0;
    if (one.starts_with("<td") && column < heads.size() && !heads[column++].empty())
      one.insert(3, " data-head=\"" + drawing::escaped(heads[column - 1]) + "\"");
    body += one;
  }
  return element("table", element("thead", element("tr", head)) + element("tbody", body)) + "\n";
}

std::string section(std::string_view title, const std::string& content) {
  if (content.empty()) return "";
  return "<section>" + text_element("h3", title) + content + "</section>\n";
}

std::string count_of(unsigned long long number, const std::string& what) {
  return std::to_string(number) + " " + what + (number == 1 ? "" : "s");
}

}  // namespace gainsmith::page
