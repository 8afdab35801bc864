// The number type "affine form": matrices that are affine in the unknown scalars x_1 ... x_m, with
// coefficients that combine monomials phi_a in the variables of `forall` (forall/monomials.h):
//   M(x, tau) = sum over (a, i) of phi_a(tau) x_i M_ai + sum over products of phi_a(tau) E V(x) F,
//   phi_0 = 1, x_0 = 1.
// Large matrices V among the unknowns occur in products, not by the coefficients of their scalars:
// those are many, and operations on them cost more than all else.
#pragma once

#include <map>
#include <set>
#include <utility>
#include <vector>

#include "forall/monomials.h"
#include "lmi/products.h"
#include "lmi/sparse.h"
#include "lmi/unknowns.h"
#include "numbers/matrix.h"

namespace gainsmith::lmi {

/// M(x, tau), of `shape`. A scalar may be in terms and, with its matrix, in products.
struct AffineForm {
  using Key = std::pair<int, int>;

  expr::Shape shape;
  std::map<Key, Sparse> terms;         ///< (monomial, unknown) -> M_ai; zeros are left out
  std::vector<Product> products = {};  ///< none has a side that is zero

  bool is_constant() const;
  /// Whether an unknown occurs in it; then `which` is the index of one.
  bool has_unknown(int* which = nullptr) const;
};

/// The same form without products.
AffineForm expanded(const AffineForm& form);

/// Whether both have the same shape and, expanded, the same terms, bit by bit.
bool is_same(const AffineForm& a, const AffineForm& b);

/// A constant matrix.
AffineForm constant_form(const numbers::Matrix& matrix);
/// The unknown matrix itself.
AffineForm unknown_form(const Unknown& unknown);
/// A variable of the table: the function tau itself, or the convex combination of the vertices.
AffineForm variable_form(forall::MonomialTable& monomials, int variable);

/// Adds a coefficient to a form; what cancels is left out.
void add_term(AffineForm& form, AffineForm::Key key, const Sparse& matrix);
void add_term(AffineForm& form, AffineForm::Key key, const Sparse& matrix, double factor);

/// Adds factor times `other`, with its first element at (row, column).
void add_placed(AffineForm& form, const AffineForm& other, int row, int column, double factor = 1);
AffineForm transposed(const AffineForm& form);

/// The matrix of a constant form; of another one its part without unknowns and variables.
numbers::Matrix dense_constant(const AffineForm& form);

/// The affine form of a program, with the unknowns and the variables of the table. EvaluationError
/// at the place of an operation that leaves affine forms.
AffineForm evaluate_affine(const expr::Program& program, const Unknowns& unknowns,
                           forall::MonomialTable& monomials, const numbers::Values& values);

/// With the values of a point besides.
AffineForm evaluate_at(const expr::Program& program, const Unknowns& unknowns,
                       forall::MonomialTable& monomials, const numbers::Values& values,
                       const forall::Point& point);

/// The monomials that occur in a form, but for the constant.
std::set<int> monomials_in(const AffineForm& form);

/// Removes the monomials whose terms are rounding noise (forall::noise), each element beside the
/// largest one of the same unknown at its place.
void remove_noise(AffineForm& form, const forall::MonomialTable& monomials);

/// The form with numbers for its monomials: values[a] for phi_a, values[0] = 1.
AffineForm at_vertex(const AffineForm& form, const std::vector<double>& values);

/// The matrix of a form without monomials at x, x[i - 1] being scalar i.
numbers::Matrix value_of(const AffineForm& form, const std::vector<double>& x);

}  // namespace gainsmith::lmi
