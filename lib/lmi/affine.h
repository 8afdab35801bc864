// The number type "affine form": matrices that are affine in the unknown scalars x_1 ... x_m, with
// coefficients that combine monomials phi_a in the variables of `forall` (monomials.h):
//   M(x, tau) = sum over (a, i) of phi_a(tau) x_i M_ai,    phi_0 = 1, x_0 = 1.
#pragma once

#include <Eigen/SparseCore>
#include <map>
#include <span>
#include <utility>

#include "expr/evaluate.h"
#include "numbers/matrix.h"
#include "lmi/monomials.h"
#include "lmi/unknowns.h"

namespace gainsmith::lmi {

using Sparse = Eigen::SparseMatrix<double>;

/// The largest |element|.
double largest_element(const Sparse& matrix);

struct AffineForm {
  expr::Shape shape;
  std::map<std::pair<int, int>, Sparse> terms;  ///< (monomial, unknown) -> M_ai; zeros are left out

  bool is_constant() const;
  /// Whether an unknown stands in it; then `which` is the index of one.
  bool has_unknown(int* which = nullptr) const;
};

/// Whether both have the same shape and the same terms, bit by bit.
bool is_same(const AffineForm& a, const AffineForm& b);

/// A constant matrix.
AffineForm constant_form(const numbers::Matrix& matrix);
/// The unknown matrix itself.
AffineForm unknown_form(const Unknown& unknown);
/// A variable of the table: the function tau itself, or the convex combination of the vertices.
AffineForm variable_form(MonomialTable& monomials, int variable);

/// The expr algebra. Sums, products with what has no unknown, blocks, transposes and the like are
/// affine; any function may be applied to constants; exp, sin and cos also to an affine function of
/// one variable, and expm to M + F*tau with M F = F M (residues.h). Everything else throws
/// EvaluationError with the unknown, or the function of tau, at fault.
struct AffineAlgebra {
  using Value = AffineForm;

  MonomialTable* monomials = nullptr;
  const Unknowns* unknowns = nullptr;

  void apply(const expr::Instruction& instruction, std::span<const AffineForm* const> operands,
             AffineForm& out) const;
};

}  // namespace gainsmith::lmi
