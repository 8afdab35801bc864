#include "page/rows.h"

#include "page/element.h"
#include "page/lines.h"
#include "page/mathml.h"
#include "page/symbol.h"

namespace gainsmith::page {

std::string formula_row(std::string_view name, const std::string& mathml,
                        const std::string& remark) {
  std::string cells;
  if (!name.empty()) cells += text_element("span", name, R"(class="name")");
  if (!mathml.empty()) cells += element("div", formula(mathml), R"(class="wide")");
  if (!remark.empty()) cells += element("span", remark, R"(class="remark")");
  return element("div", cells, R"(class="row")") + "\n";
}

std::string group(std::string_view title, const std::string& rows) {
  return rows.empty() ? "" : text_element("h4", title) + rows;
}

std::string folded(std::string_view title, const std::string& content) {
  return content.empty() ? "" : element("details", text_element("summary", title) + content) + "\n";
}

std::string equation(const std::string& left, const std::string& right, std::string_view sign) {
  return row(left + mo(sign) + right);
}

std::string value_mathml(const model::Value& value, const Notation& notation) {
  if (value.value.root) return mathml(value.value, notation);
  std::vector<std::string> members;
  for (const model::Value& matrix : value.matrices)
    members.push_back(value_mathml(matrix, notation));
  return row(listed(members));
}

std::string range_mathml(const std::vector<expr::Expression>& ends, const Notation& notation,
                         std::string_view open, std::string_view close) {
  std::vector<std::string> parts;
  for (const expr::Expression& end : ends) parts.push_back(mathml(end, notation));
  return parts.size() == 1 && open == "[" ? parts.front() : fenced(listed(parts), open, close);
}

std::string declared(const std::string& name, const std::vector<expr::Index>& indices,
                     const Notation& notation) {
  if (indices.empty()) return name_mathml(name, notation);
  std::vector<std::string> below;
  for (const expr::Index& index : indices) below.push_back(symbol(index.name));
  return symbol(name, below);
}

std::string for_all_text(const std::vector<expr::Index>& indices, const Notation& notation) {
  std::string text;
  for (const expr::Index& index : indices)
    text += (text.empty() ? "for " : ", ") + formula(index_mathml(index, notation));
  return text;
}

}  // namespace gainsmith::page
