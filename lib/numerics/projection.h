// The nearest point of a convex set in the metric of a positive definite matrix.
//
//   minimise (z - x)' P (z - x)   over z in the set,      P n x n, symmetric part > 0; x, z n x 1
//
//   polytope    { z : A z <= b }                    P (z - x) + A' y = 0, y >= 0,
//                                                   y_i (b - A z)_i = 0
//   ellipsoid   { z : (z - x0)' Q (z - x0) <= r }   P (z - x) + y Q (z - x0) = 0, y >= 0
//   affine set  { z : A z = b }                     P (z - x) + A' y = 0
//
// On the right what makes z the nearest point (Karush, Kuhn and Tucker), with the multipliers y.
// The nearest point is unique, and z is no farther from any point of the set than x is, in the
// metric P: the proof that an observer's certificate (xh - x)' P (xh - x) survives the projection.
//
// Results are those of exact arithmetic on the given numbers, rounded once: Scalar double is
// computed in 31 digits, 31 digits in 100. A row a'z <= b counts as satisfied, and an x as inside,
// when it is so within the rounding of z itself, epsilon (|a|'|z| + |b|); such an x is returned bit
// by bit, and so is the projection of a projection onto a polytope.
#pragma once

#include <Eigen/Core>
#include <stdexcept>

#include "numerics/matrix.h"

namespace gainsmith::numerics {

template <class Scalar>
struct Projection {
  MatrixOf<Scalar> point;        ///< z, n x 1
  MatrixOf<Scalar> multipliers;  ///< y: m x 1; 1 x 1 of an ellipsoid; zeros where z is x
};

/// "P is not positive definite", "the polytope is empty": there is no nearest point.
struct NoProjection : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A m x n, b m x 1. Rows may be redundant, parallel, zero or meet in one point in any number.
/// Rows that the rounding of A could make dependent are taken as dependent; where such rows
/// contradict each other the set is called empty.
///
/// The dual active-set method of Goldfarb and Idnani (Mathematical Programming 27, 1983) on
/// d = L'(z - x), P = L L': minimise d'd. Every step to a new active set makes d'd larger, also
/// with degenerate rows, so no active set comes twice.
template <class Scalar>
Projection<Scalar> project_polytope(const MatrixOf<Scalar>& x, const MatrixOf<Scalar>& P,
                                    const MatrixOf<Scalar>& A, const MatrixOf<Scalar>& b);

/// x0 n x 1, Q n x n with symmetric part >= 0, r >= 0 the level of the form, not the square of a
/// radius. A singular Q is a cylinder; r = 0 leaves x0 and the kernel of Q.
///
/// With d = V'L'(z - x0), P = L L', the metric is d'd and the form d' diag(q) d; with c for z = x
/// the nearest point has d_i = c_i / (1 + y q_i), where y > 0 is the root of the secular equation
///   sum_i q_i c_i^2 / (1 + y q_i)^2 = r,
/// by Newton steps on 1 / sqrt of both sides, which rise to the root from y = 0, and bisection
/// where rounding throws one out of the bracket (Conn, Gould and Toint, Trust-Region Methods, 7.3).
template <class Scalar>
Projection<Scalar> project_ellipsoid(const MatrixOf<Scalar>& x, const MatrixOf<Scalar>& P,
                                     const MatrixOf<Scalar>& x0, const MatrixOf<Scalar>& Q,
                                     const MatrixOf<Scalar>& r);

/// A m x n, b m x 1. Rows that depend on others to rounding are left out; where they contradict the
/// others by more than rounding the set is empty. With full rank z = x - inv(P) A' inv(A inv(P) A')
/// (A x - b).
template <class Scalar>
Projection<Scalar> project_affine(const MatrixOf<Scalar>& x, const MatrixOf<Scalar>& P,
                                  const MatrixOf<Scalar>& A, const MatrixOf<Scalar>& b);

}  // namespace gainsmith::numerics
