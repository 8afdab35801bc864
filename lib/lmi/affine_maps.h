// Internal to lmi: linear maps of affine forms, one an operation.
#pragma once

#include <span>
#include <vector>

#include "expr/program/program.h"
#include "lmi/affine.h"

namespace gainsmith::lmi {

/// The form with every coefficient mapped linearly; it has no products.
template <class Map>
AffineForm map_terms(const AffineForm& form, expr::Shape shape, Map map) {
  AffineForm result{shape, {}};
  for (const auto& [key, matrix] : form.terms) add_term(result, key, map(matrix));
  return result;
}

/// A matrix from the elements of `matrix` moved to other places.
template <class Move>
Sparse moved(const Sparse& matrix, int rows, int cols, Move move) {
  std::vector<Eigen::Triplet<double>> elements;
  for (int k = 0; k < matrix.outerSize(); ++k)
    for (Sparse::InnerIterator it(matrix, k); it; ++it) move(it, elements);
  Sparse result(rows, cols);
  result.setFromTriplets(elements.begin(), elements.end());
  return result;
}

/// a + factor b.
AffineForm sum(const AffineForm& a, const AffineForm& b, double factor);

/// [a, b; c, d]: operands row by row, as many in a row of blocks as the first attribute says.
AffineForm blocks(const expr::Instruction& instruction,
                  std::span<const AffineForm* const> operands);
/// A part of rows and columns, from the places that the attributes give.
AffineForm index(const expr::Instruction& instruction, const AffineForm& form);

// Of forms without products:
/// The scalar times the identity.
AffineForm identity(const AffineForm& form, expr::Shape shape);
/// 1 x 1.
AffineForm trace(const AffineForm& form);
/// diagonal_of or diagonal_matrix.
AffineForm diagonal(const expr::Instruction& instruction, const AffineForm& form);

}  // namespace gainsmith::lmi
