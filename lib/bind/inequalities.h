// Internal to bind: the inequalities and the objective.
#pragma once

#include <string>
#include <vector>

#include "bind/binding.h"
#include "expr/text/ast.h"

namespace gainsmith::bind {

/// Adds inequalities, those that are necessary for any gains, and the objective to the design.
/// InputError as of bind(), and for an objective without inequalities.
void bind_inequalities(Binding& binding);

/// Adds the comparisons to an inequality: "flow", or "flow.1", "flow.2" of several; of a family
/// "flow.1 at i = 2".
void add_comparisons(const std::vector<expr::Expression>& comparisons,
                     model::Design::Inequality& bound, const std::string& stem,
                     const std::string& member, const expr::Scope& scope);

}  // namespace gainsmith::bind
