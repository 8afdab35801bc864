// Inequalities that are symmetric only where equations say so, and why others are not.
#pragma once

#include <optional>
#include <vector>

#include "lmi/affine.h"
#include "lmi/block.h"
#include "lmi/inequalities.h"

namespace gainsmith::lmi {

/// Columns (e_0, e_1, ..., e_m) with e_0 + sum_i e_i x_i = 0 for every solution: the elements
/// beside a diagonal element that is 0 for all unknowns, of blocks with >=.
std::vector<numbers::Vector> equations_in(const std::vector<Block>& blocks, int unknowns);

/// The symmetric part of a form M without monomials whose M - M' is a combination of the equations,
/// so that M is symmetric at every solution; none where it is not.
std::optional<AffineForm> symmetric_where(const AffineForm& form,
                                          const std::vector<numbers::Vector>& equations);

/// An unknown of shape n x n that keeps the form from being symmetric: with it, and perhaps others,
/// symmetric the form would be too, without it not. nullptr when there is none.
const model::Design::Unknown* needs_symmetric(const AffineForm& form, const Inequalities& of);

}  // namespace gainsmith::lmi
