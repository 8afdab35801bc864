// Whole numbers that satisfy linear equations exactly, near a point.
//
//   A X = b,  X whole,  X near x
//
// The equations are taken one by one, with a basis of the moves v that keep those before: at first
// the unit vectors. Of the moves that change the next one, a v != 0, groups of a few are reduced as
// vectors (v, K a v) with K large (Lenstra, Lenstra & Lovasz 1982, in whole numbers: Cohen, A
// course in computational algebraic number theory, 2.6.7), until a single one with a v != 0 is
// left; the others are short and keep this equation too. The one left brings X onto it, or none
// does. The others are then reduced all together, with steps that double chooses, and along them
// Babai's nearest plane brings X back near x.
#pragma once

#include <optional>
#include <vector>

#include "numerics/rational_matrix.h"

namespace gainsmith::numerics {

using IntegerVector = std::vector<Integer>;

/// A basis of the same lattice, short and nearly orthogonal. The vectors are independent.
std::vector<IntegerVector> reduced_basis(std::vector<IntegerVector> basis);

/// X as above; none when no whole numbers satisfy the equations.
std::optional<IntegerVector> whole_solution(const RationalMatrix& A, const RationalMatrix& b,
                                            const std::vector<Rational>& near);

}  // namespace gainsmith::numerics
