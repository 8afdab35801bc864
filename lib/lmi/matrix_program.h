// The semidefinite program of a formulation with its matrices as unknowns
// (sdp/schur/matrix_program.h).
#pragma once

#include <optional>
#include <vector>

#include "lmi/formulation.h"
#include "sdp/schur/matrix_program.h"

namespace gainsmith::lmi {

/// The same program as Formulation::problem: its blocks in their order, those of one row that state
/// linear inequalities as rows, its variables in their order. Rows are in balanced units and so are
/// the scalars outside of the matrices; a matrix is in the units of the problem, for the balanced
/// ones of its scalars are no product of units of rows and columns. `round`: of Goal::interior.
///
/// None when no unknown is a matrix that occurs in products in all blocks (Block::products), when
/// scalars are free or rows left out, and for a round with a margin, t diag(B_k(x)) being no
/// such product.
std::optional<sdp::MatrixProgram> matrix_program(const Lmi& lmi, const GainBounds& bounds,
                                                 const Formulation& formulation,
                                                 const Round& round);

/// The variables of the formulation from those of its matrix program: scalars of matrices are
/// divided by their units d_i.
std::vector<double> balanced_variables(const Formulation& formulation,
                                       const sdp::MatrixProgram& program,
                                       const std::vector<double>& x);

}  // namespace gainsmith::lmi
