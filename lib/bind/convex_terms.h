// Internal to bind: requirements and objectives with convex functions of unknowns (convex.h), each
// bounded by an unknown of its own, which is added to the design with its inequality.
#pragma once

#include <vector>

#include "bind/binding.h"
#include "expr/text/ast.h"

namespace gainsmith::bind {

/// A comparison chain without convex functions of unknowns: the chain itself where there are none.
/// `quantified`: it is under a `forall` with an interval or a set.
std::vector<expr::Expression> affine_comparisons(Binding& binding, const expr::Expression& stated,
                                                 expr::Scope& scope, bool quantified);

/// The objective without them: it is minimised, so convex terms are bounded from above. InputError
/// for concave ones.
expr::Expression affine_objective(Binding& binding, const expr::Expression& text);

}  // namespace gainsmith::bind
