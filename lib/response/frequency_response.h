// H at points of the imaginary axis, or of the unit circle.
#pragma once

#include <complex>

#include "response/state_space.h"

namespace gainsmith::response {

using ComplexMatrix = Eigen::Matrix<std::complex<double>, Eigen::Dynamic, Eigen::Dynamic>;

/// A is balanced and brought to Hessenberg form once, in O(n^3); each frequency then costs O(n^2)
/// (Laub, IEEE Trans. Automatic Control 26, 1981).
class FrequencyResponse {
 public:
  explicit FrequencyResponse(const StateSpace& system);

  /// H(i w), or H(exp(i w T)): p x m. w in radians per unit of time. Not finite at a pole.
  ComplexMatrix at(double w) const;
  /// The largest singular value of H; 0 of an H without elements.
  double largest_gain(double w) const;

 private:
  /// Q'A Q in Hessenberg form, Q'B, C Q in balanced units, with Q orthogonal; D.
  Matrix A_, B_, C_, D_;
  double step_;
};

/// The min(p, m) singular values of a response that is not empty, largest first.
numbers::Vector gains_of(const ComplexMatrix& response);

}  // namespace gainsmith::response
