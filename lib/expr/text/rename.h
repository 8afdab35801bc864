// Names of an expression in place of others; its text and its places stay.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "expr/text/ast.h"

namespace gainsmith::expr {

/// The name that replaces another one; none: it stays.
using Renaming = std::function<std::optional<std::string>(const std::string&)>;

/// The expression with other names for values, functions and events. An index of a sum keeps its
/// own.
/// Only trees change: messages quote the text as it was written.
Expression renamed(const Expression& expression, const Renaming& to);

/// Calls `visit` for each node that is a name or a call of one, an index of a sum left out.
void visit_names(const Expression& expression, const std::function<void(const Node&)>& visit);

}  // namespace gainsmith::expr
