// Internal to bind: convex functions of unknowns as the inequalities that represent them.
//
//   norm(M) <= g           [g*I, M; M', g*I] >= 0
//   abs(v) <= g            -g <= v <= g, element by element
//   max(a, b, ...) <= g    a <= g, b <= g, ..., element by element
//   lambda_max(M) <= g     M <= g*I
//
// and min and lambda_min likewise from above. Where such a function is a term among others, as in
// norm(M) + 2*norm(X) <= g or minimize: sum(abs(v)), an unknown of its own replaces it and bounds
// it: the sum can be small exactly when the bounds can.
#pragma once

#include <optional>
#include <vector>

#include "expr/text/ast.h"

namespace gainsmith::bind {

/// Whether the call is one of those functions, and from which side it is bounded.
/// Convex functions are bounded from above, concave ones from below.
enum class Curvature { convex, concave };
std::optional<Curvature> curvature_of(const expr::Node& node);

/// The comparisons that say: the function at `call` is at most (at least, of a concave one)
/// `bound`. `arguments`: the shapes of its arguments; `strict`: < instead of <=.
std::vector<expr::NodePtr> comparisons_of(const expr::Node& call, const expr::NodePtr& bound,
                                          const std::vector<expr::Shape>& arguments,
                                          bool bound_is_number, bool strict);

}  // namespace gainsmith::bind
