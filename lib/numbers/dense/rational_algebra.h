// Linear algebra over fractions: nothing is rounded, and what is said is certain.
//
//   kernel, solutions   the reduced echelon form of Gauss and Jordan, O(m n rank) operations
//   definiteness        M = L D L' by symmetric elimination without exchanges:
//                       M > 0 if and only if all pivots are > 0
//   independence        the rank of M modulo the prime 2^31 - 1, which is not above that of M
//
// Numbers grow with each step of an elimination: a pivot is a quotient of two minors of M.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "numbers/types/rational.h"

namespace gainsmith::numbers {

/// Whether all elements are 0; true of an empty matrix.
bool is_rational_zero(const RationalMatrix& M);

/// A B, quick where elements are 0.
RationalMatrix rational_product(const RationalMatrix& A, const RationalMatrix& B);

/// The reduced echelon form of M without its rows of zeros: row r has a 1 in column pivots[r],
/// where the other rows have 0.
struct Echelon {
  RationalMatrix rows;
  std::vector<Eigen::Index> pivots;
};
Echelon reduced_echelon(RationalMatrix M);

/// Columns that are a basis of {x : M x = 0}: each has a 1 where the others have 0.
RationalMatrix rational_kernel(const RationalMatrix& M);

/// Whether the columns of M are independent, told by their images in the numbers modulo a prime:
/// true is certain, and false means that they may be dependent.
bool are_surely_independent(const RationalMatrix& M);

/// Some X with M X = B; none when there is none.
std::optional<RationalMatrix> rational_solution(const RationalMatrix& M, const RationalMatrix& B);

/// None for a singular matrix.
std::optional<RationalMatrix> rational_inverse(const RationalMatrix& M);

/// M = sum_k d_k v_k v_k' with d_k > 0 and v_k n x 1, for M > 0, from M = L D L': v_k is column k
/// of L. Empty for other symmetric matrices.
std::vector<std::pair<Rational, RationalMatrix>> rational_squares(RationalMatrix M);

/// Of a symmetric matrix, n x n, by elimination: a vector v != 0, n x 1, with v'Mv < 0, or <= 0
/// when it must be definite; none when it is as it must be.
std::optional<RationalMatrix> rational_witness(RationalMatrix M, bool definite);

/// Whether v'Mv > 0 (>= 0) for all v != 0. Empty matrices are both.
bool is_rational_definite(const RationalMatrix& M);
bool is_rational_semidefinite(const RationalMatrix& M);

}  // namespace gainsmith::numbers
