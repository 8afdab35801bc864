// The inequalities of an instance, ready to be evaluated: what each states is given here once,
// for the blocks that are solved (compile.h) and for the margins that are recomputed
// (verdict/margins.h).
//
// The room turns matrix inequalities M(x, tau) > 0 for all tau of a domain, affine in unknown
// matrices, into finitely many blocks B_k(x) = B_k0 + sum_i x_i B_ki >= 0 in a vector x of scalars,
// and these into semidefinite programs. Coefficients are doubles. A program here is a question to a
// solver: whether an answer counts is decided from decimals and multipliers elsewhere.
//   unknowns                                      matrices packed into x
//   affine*, evaluate_affine, products            forms that are affine in x
//   sparse, gather                                their coefficients
//   compile, block, symmetry, vertex_gains        from forms to blocks
//   gain_bounds, gain_units                       bounds on gains, as further blocks
//   balance, balance_elements, free_rows          units by powers of two
//   free_variables, scale                         scalars without a price, or with a known sign
//   formulation, assembler, matrix_program        the semidefinite programs, and back
//   correlation                                   a margin without units
// Sources: Boyd, El Ghaoui, Feron & Balakrishnan 1994 for matrix inequalities, Curtis & Reid 1972
// for units.
#pragma once

#include <optional>
#include <vector>

#include "forall/box.h"
#include "forall/domain.h"
#include "lmi/unknowns.h"
#include "model/function.h"
#include "model/instance.h"

namespace gainsmith::lmi {

/// An inequality for all values of its variables.
struct Statement {
  const model::Design::Inequality* stated = nullptr;
  forall::Domain domain;                   ///< with numbers
  std::vector<expr::Program> differences;  ///< one a comparison, unknown functions linked
};

/// Unknown functions are polynomials of their declared degree or, when the problem asks for gains
/// at the vertices of a box, have one coefficient for each vertex (vertex_gains.h).
struct Inequalities {
  /// InputError, at its place, for an empty interval and what vertex_box() refuses.
  explicit Inequalities(const model::Instance& of);

  const model::Design& design() const { return *instance.design; }

  model::Instance instance;
  std::optional<forall::Box> box;          ///< of vertex gains
  std::vector<model::Function> functions;  ///< unknown functions of a variable
  model::Bodies bodies;
  Unknowns unknowns;                  ///< coefficients of functions among them
  std::vector<Statement> statements;  ///< in the order of the method
};

}  // namespace gainsmith::lmi
