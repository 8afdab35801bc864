// Bounds of errors that take many steps  e+ = E e + d,  |d_i| <= delta_i.
//
// Bounds element by element would grow with the powers of |E|, which says nothing of E. Instead
// the error is e = a + b, |b_i| <= z_i, where a is the sum of m errors with
//
//   |c' a|^2 <= m |G' c|^2   for every c,   so that   |e_i| <= sqrt(m) |row i of G| + z_i
//
// and a step takes  G+ = E G,  z+ = |E| z + delta + what the rounding of E G adds. So old errors
// turn and decay as the steps do, and only what came since the last gather() grows with |E|.
// gather() makes one more error of a of it,
//
//   [G, sqrt(n) diag(z)]' = Q R,   G+ = R',   m+ = m + 1,   z+ = 0
//
// because |c' b| <= sqrt(n) |diag(z) c|, and |c' a| + |c' b| <= sqrt(m + 1) times the root of the
// sum of both squares (Cauchy and Schwarz). Computed in double; the rounding of E G is at most
// eps |E| |row of G|, so G may fall over hundreds of decades.
#pragma once

#include <Eigen/Core>

#include "numbers/matrix.h"

namespace gainsmith::bounded {

class ErrorEllipsoid {
 public:
  /// Errors with |e_i| <= delta_i.
  void start(const Eigen::VectorXd& delta);
  /// `E` in double, `sizes` = |E|; E has no error but its rounding.
  void step(const numbers::Matrix& E, const numbers::Matrix& sizes, const Eigen::VectorXd& delta);
  /// Takes z into G: sharper steps follow.
  void gather();

  /// |e_i| is at most this.
  const Eigen::VectorXd& bounds() const { return bounds_; }

 private:
  void set_bounds();
  void rescale(double largest);
  void triangulate();

  Eigen::VectorXd bounds_;
  numbers::Matrix G_, product_;
  Eigen::VectorXd norm_;  ///< of the rows of G_
  Eigen::VectorXd z_, reach_;
  double scale_ = 1;  ///< G is scale_ G_
  double terms_ = 0;  ///< m
  numbers::Matrix stacked_;
};

}  // namespace gainsmith::bounded
