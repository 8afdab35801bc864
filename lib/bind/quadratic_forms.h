// Internal to bind: convex quadratic forms of unknowns as matrix inequalities, by a Schur
// complement:
//
//   e'*Q*e <= g     [g, e'*Q; Q*e, Q] >= 0     with Q >= 0
//
// where e is a column that is affine in the unknowns. x^2 and norm(v)^2 are such forms with Q = 1.
#pragma once

#include <optional>

#include "expr/text/ast.h"

namespace gainsmith::bind {

struct QuadraticForm {
  expr::NodePtr column;  ///< e, n x 1
  expr::NodePtr row;     ///< e'
  expr::NodePtr weight;  ///< Q, n x n or 1 x 1; none for 1
};

/// The form that a node may be, by its text alone: e'*e, w*e'*Q*e, x*x, x^2, norm(v)^2,
/// sum(v.^2). The first two are numbers, and the third has a number x, only where the shapes say
/// so.
std::optional<QuadraticForm> quadratic_form(const expr::NodePtr& node);

/// [bound, e'*Q; *, Q] >= 0, of n elements, or > 0. `weight_is_number`: Q is a multiple of I.
expr::NodePtr comparison_of(const QuadraticForm& form, const expr::NodePtr& bound, int n,
                            bool weight_is_number, bool strict);

/// -(a*b*...) for (-a)*b*..., a product with a leading minus; otherwise none.
expr::NodePtr negated_product(const expr::NodePtr& node);

}  // namespace gainsmith::bind
