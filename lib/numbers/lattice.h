// Whole numbers that satisfy linear equations exactly, near a point.
//
//   A X = b,  X whole,  X near x
//
// With K large the vectors (K A e_i, e_i) are reduced (Lenstra, Lenstra & Lovasz 1982, in whole
// numbers: Cohen, A course in computational algebraic number theory, 2.6.7): the first ones have
// A X = 0 and are a short basis of all such X, the others give all b that can be reached. Of the
// solutions one near x is taken, by Babai's nearest plane.
#pragma once

#include <optional>
#include <vector>

#include "numbers/rational.h"

namespace gainsmith::numbers {

using IntegerVector = std::vector<Integer>;

/// A basis of the same lattice, short and nearly orthogonal. The vectors are independent.
std::vector<IntegerVector> reduced_basis(std::vector<IntegerVector> basis);

/// X as above; none when no whole numbers satisfy the equations. The rows of A are independent.
std::optional<IntegerVector> whole_solution(const RationalMatrix& A, const RationalMatrix& b,
                                            const std::vector<Rational>& near);

}  // namespace gainsmith::numbers
