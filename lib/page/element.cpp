#include "page/element.h"

#include <algorithm>

#include "report/text.h"

namespace gainsmith::page {

std::string element(std::string_view tag, std::string_view content, std::string_view attributes) {
  std::string text = "<";
  text += tag;
  if (!attributes.empty()) text.append(" ").append(attributes);
  text.append(">").append(content).append("</").append(tag).append(">");
  return text;
}

std::string text_element(std::string_view tag, std::string_view text, std::string_view attributes) {
  return element(tag, report::escaped(text), attributes);
}

std::string preformatted(std::string_view text, std::string_view attributes) {
  std::string lines;
  for (;;) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    lines += report::escaped(text.substr(0, end));
    if (end == text.size()) return element("pre", lines, attributes);
    lines += '\n';
    text.remove_prefix(end + 1);
  }
}

std::string formula(std::string_view mathml) { return element("math", mathml); }

std::string section(std::string_view title, const std::string& content) {
  if (content.empty()) return "";
  return "<section>" + text_element("h3", title) + content + "</section>\n";
}

std::string count_of(unsigned long long number, const std::string& what) {
  return std::to_string(number) + " " + what + (number == 1 ? "" : "s");
}

}  // namespace gainsmith::page
