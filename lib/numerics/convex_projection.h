// The nearest point of { z : c(z) <= 0 }, with m convex functions c, in the metric of a positive
// definite matrix.
//
//   minimise (z - x)' P (z - x)   over c(z) <= 0,      P n x n, symmetric part > 0; x, z n x 1
//
//   P (z - x) + c'(z)' y = 0,  y >= 0,  y_i c_i(z) = 0         (Karush, Kuhn and Tucker)
//
// The multipliers y are those of the largest min over z of the Lagrangian
//
//   L(z, y) = (z - x)' P (z - x) / 2 + y'c(z)   over y >= 0.
//
// From y = 0 and z = x, Newton's steps for that maximum are steps of sequential quadratic
// programming (Nocedal and Wright, Numerical Optimization, 18): with the tangents of c at z for c,
// and the metric H = P + sum_i y_i c_i''(z), each is a projection onto a polytope (projection.h),
//
//   minimise (w - v)' H (w - v)   over c(z) + c'(z) (w - z) <= 0,   v = z - inv(H) P (z - x).
//
// A step is halved until the minimum grows; the minimum over z is found by Newton's method too,
// only as well as that needs. Near the end the steps are taken as they are, and the error squares.
//
// The end is that z is the point of its own tangents nearest to x, in the metric P: with the
// multipliers y of that projection, P (z - x) + c'(z)'y = P (z - w) = 0, and z is feasible.
//
// The tangents of convex functions hold the set: where they have no common point it is empty. A
// tangent above its function at another point, or a curvature below 0, shows that a function is not
// convex. Where neither shows, that is not noticed, and the conditions hold at z.
//
// The result is that of exact arithmetic on the given numbers, rounded once, as those of
// projection.h are: c is asked for in the working arithmetic. An x with
// c_i(x) <= epsilon (|a|'|x| + |b|), for the tangents a'z <= b at x, is inside and returned bit by
// bit.
#pragma once

#include <functional>

#include "numerics/projection.h"
#include "numerics/working.h"

namespace gainsmith::numerics {

/// Functions near a point z.
template <class W>
struct Tangents {
  MatrixOf<W> value;  ///< c(z), m x 1
  MatrixOf<W> slope;  ///< c'(z), m x n; for a derivative m x (n + q), by q other directions too
};
/// NoProjection, with the reason, where they have no value: shorter steps avoid such points.
template <class W>
using Functions = std::function<Tangents<W>(const MatrixOf<W>& z)>;

/// NoProjection: P is not positive definite, the set is empty, c is not convex, no convergence.
///
/// The second derivatives are differences of slopes at z +- h e_j, with h = eps^(1/3) of the size
/// of z_j in the working arithmetic: their error is some eps^(2/3), below the rounding of S.
template <class S>
Projection<S> project_convex(const MatrixOf<S>& x, const MatrixOf<S>& P,
                             const Functions<Working<S>>& c);

/// dz, n x q, of the z that project_convex gave, as x, P and c move in q directions: dx n x q, dP
/// n^2 x q column by column. With the functions A that have y > 0, by the conditions above,
///
///   [ H  c_A' ] [ dz ]   [ P dx - dP (z - x) - sum_i y_i dc_i'  ]
///   [ c_A   0 ] [ dy ] = [ -dc_A                                ]
///
/// A function with y = 0 does not count, also where z is on its boundary by chance.
template <class S>
MatrixOf<Working<S>> slope_of_projection(const Projection<S>& z, const MatrixOf<S>& x,
                                         const MatrixOf<S>& P, const MatrixOf<Working<S>>& dx,
                                         const MatrixOf<Working<S>>& dP,
                                         const Functions<Working<S>>& c);

}  // namespace gainsmith::numerics
