// Bounds, by pieces, between the points at which an inequality was looked at: that it holds there
// too.
//
//   B(t) = sum_a phi_a(t) B_a,   t in a box, phi_a the functions of monomials.h.
//
// On a piece with edges w_i the multilinear interpolation of B is a mean of its values B(c) at the
// corners, and B differs from it, as a quadratic form, by at most
//   sum_i w_i^2/8 sup |d^2 B/dt_i^2|.
// With L L' the mean of the B(c), B > 0 on the piece when
//   min_c lambda_min(L^-1 B(c) L^-T) > sum_i w_i^2/8 sum_a |L^-1 B_a L^-T| sup |d^2 phi_a/dt_i^2|,
// which does not depend on units. A piece that does not pass is halved along the edge with the
// largest term. All of it is computed in double: it holds up to rounding.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "forall/domain.h"
#include "forall/monomials.h"
#include "forall/worst.h"

namespace gainsmith::forall {

/// B(t) as its coefficients: (index of a monomial, B_a).
using Expansion = std::vector<std::pair<int, numbers::Matrix>>;

/// The expansion of an inequality with numbers for everything but its intervals, which are the
/// variables of the table; none when it is no sum of monomials.
using Expand =
    std::function<std::optional<Expansion>(const Point& fixed, MonomialTable& monomials)>;

struct DomainBound {
  enum class Status {
    holds,
    violated,  ///< `violations` are points where the smallest eigenvalue is below what is allowed
    open,      ///< too many pieces; `where` is one that is left
    unknown    ///< the text is no sum of functions whose derivatives are bounded
  };
  Status status = Status::holds;
  std::vector<Minimum> violations;  ///< at most 16 for each element of the sets and polytopes
  std::string where;                ///< "tau in [0.2, 0.25]"
};

/// Whether B(t) plus `slack` I is positive definite on the whole domain; the vertices of polytopes
/// stand for them.
DomainBound bound_on_domain(const Expand& expand, const Domain& domain, double slack);

}  // namespace gainsmith::forall
