// A proof, by pieces, that an inequality holds between the points at which it was looked at.
//
//   B(t) = sum_a phi_a(t) B_a,   t in a box, phi_a the functions of monomials.h.
//
// On a piece with edges w_i the multilinear interpolation of B is a mean of its values B(c) at the
// corners, and B differs from it, as a quadratic form, by at most
//   sum_i w_i^2/8 sup |d^2 B/dt_i^2|.
// With L L' the mean of the B(c), B > 0 on the piece when
//   min_c lambda_min(L^-1 B(c) L^-T) > sum_i w_i^2/8 sum_a |L^-1 B_a L^-T| sup |d^2 phi_a/dt_i^2|,
// which does not depend on units. A piece that does not pass is halved along the edge with the
// largest term. The proof is one up to rounding in double.
#pragma once

#include <string>
#include <vector>

#include "expr/program.h"
#include "lmi/domain.h"
#include "lmi/worst.h"

namespace gainsmith::lmi {

struct DomainProof {
  enum class Status {
    proved,
    violated,  ///< `violations` are points where the smallest eigenvalue is below what is allowed
    open,      ///< too many pieces; `where` is one that is left
    unknown    ///< the text is no sum of functions whose derivatives are bounded
  };
  Status status = Status::proved;
  std::vector<Minimum> violations;  ///< at most 16 for each element of the sets and polytopes
  std::string where;                ///< "tau in [0.2, 0.25]"
};

/// Whether the matrix given as text plus `slack` I is positive definite on the whole domain; the
/// vertices of polytopes stand for them. `known` gives data, parameters and unknowns.
DomainProof prove_on_domain(const expr::Program& difference, const Domain& domain,
                            const numbers::Values& known, double slack);

}  // namespace gainsmith::lmi
