// The functions and operators of the language, as rows of operations.def: binding, messages, help
// and the tables of docs/language.md are made from them.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "expr/program/operations.h"

namespace gainsmith::expr {

/// The functions that the binder makes of operations.
enum class Composed {
#define COMPOSED(name, ...) name,
#include "expr/operations.def"
};

/// The functions that are texts of the language.
struct Written {
  std::string_view parameters;  ///< "x, lo, hi"
  std::string_view text;
  std::string_view fault;  ///< what a message says where a part has no value; may be empty
};

struct Function {
  std::variant<Op, Composed, Written> what;
  std::string_view name;
  int fewest;                ///< arguments
  int most;                  ///< -1: any number
  std::string_view usage;    ///< "clip(x, lo, hi)"
  std::string_view meaning;  ///< one line, Markdown
  std::string_view example;
  std::string_view value;  ///< of the example, as an expression
};

/// A line of the page on operators.
struct Operator {
  std::string_view usage;  ///< Markdown
  std::string_view name;
  std::string_view remark;  ///< Markdown; may be empty
  std::string_view example;
  std::string_view value;
};

/// In the order of the page.
std::span<const Function> functions();
/// From the tightest to the loosest.
std::span<const Operator> operators();

/// nullptr when there is no function of that name.
const Function* find_function(std::string_view name);

/// Names that a definition, datum or unknown may not take: the functions, I, pi,
/// derivative, end, and, or, not.
bool is_reserved(std::string_view name);

/// In the order of the page, for suggestions.
std::vector<std::string> function_names();

/// The tables of docs/language.md, in Markdown.
std::string functions_page();
std::string operators_page();

}  // namespace gainsmith::expr
