// Functions of the variables of `forall` that stay symbolic:
//   phi(v_1, ..., v_k) = f_1(v_1) ... f_k(v_k),
// with f_i an atom (atoms.h) when v_i runs over an interval, and a barycentric weight when it runs
// over a polytope:
//   A = A_1 + sum_{j > 1} alpha_j (A_j - A_1),   alpha_j >= 0,   sum_{j > 1} alpha_j <= 1.
// A matrix whose entries combine such functions is affine in the factors of each variable, the
// others held fixed. So it is definite everywhere when it is so with the factors of each variable
// at the vertices of what contains them: the box of their ranges, the simplex of the weights.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "forall/atoms.h"
#include "forall/domain.h"

namespace gainsmith::forall {

/// f_i(v_i): an atom, or the weight alpha_j with j = `weight` > 0 counted from 0.
struct Factor {
  int variable = 0;
  Atom atom;
  int weight = 0;

  bool operator==(const Factor&) const = default;
};

/// Factors that are not 1, in the order of their variables; the constant 1 has none.
using Monomial = std::vector<Factor>;

/// A combination: coefficients and indices into a table.
using Combination = std::vector<std::pair<double, int>>;

/// The monomials in use; index 0 is the constant 1.
class MonomialTable {
 public:
  /// `variables` are those that stay symbolic: over intervals and polytopes.
  explicit MonomialTable(Domain variables = {});

  const Domain& variables() const { return variables_; }
  /// -1 for a name that does not stay symbolic.
  int find_variable(const std::string& name) const;

  const Monomial& operator[](int index) const {
    return monomials_[static_cast<std::size_t>(index)];
  }
  int size() const { return static_cast<int>(monomials_.size()); }
  /// The place of a monomial, which is added where it is new.
  int index(const Monomial& monomial);
  int index(int variable, const Atom& atom);
  /// That of alpha_j, j = `weight` > 0.
  int index_of_weight(int variable, int weight);

  /// phi_a phi_b as a combination. EvaluationError for a product of two weights of one polytope.
  Combination product(int a, int b);

 private:
  Domain variables_;
  std::vector<Monomial> monomials_;
};

}  // namespace gainsmith::forall
