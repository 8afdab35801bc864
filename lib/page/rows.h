// Rows of a formula with its name and what is said of it, and groups of them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "page/notation.h"

namespace gainsmith::page {

/// One line of a list of formulas: a name at the left, the formula, a remark behind it. `remark` is
/// markup.
std::string formula_row(std::string_view name, const std::string& mathml,
                        const std::string& remark = "");

/// A group of rows below a small heading; nothing without rows.
std::string group(std::string_view title, const std::string& rows);

/// The same, folded: a heading that opens.
std::string folded(std::string_view title, const std::string& content);

/// "name = value"
std::string equation(const std::string& left, const std::string& right,
                     std::string_view sign = "=");

/// The value of a datum, of a start, of an end of a box.
std::string value_mathml(const model::Value& value, const Notation& notation);

/// "[a, b]"; one value without brackets, unless `open` is another bracket.
std::string range_mathml(const std::vector<expr::Expression>& ends, const Notation& notation,
                         std::string_view open = "[", std::string_view close = "]");

/// A name with its indices: "A_i".
std::string declared(const std::string& name, const std::vector<expr::Index>& indices,
                     const Notation& notation);

/// "for i = 1, …, N" as markup of a line of text; empty without indices.
std::string for_all_text(const std::vector<expr::Index>& indices, const Notation& notation);

}  // namespace gainsmith::page
