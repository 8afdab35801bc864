// A linear system with m inputs, n states and p outputs.
//
//   continuous   x' = A x + B u,  y = C x + D u,   H(s) = C (s I - A)^-1 B + D
//   sampled      x+ = A x + B u,  y = C x + D u,   H(z), z = exp(s T)
//
// The folder computes what is read from the matrices of such a system, in double:
//   state_space.h         poles, zeros, stability, unit feedback
//   frequency_response.h  H at one frequency in O(n^2) (Laub 1981);  sweep.h  H over a range
//   margins.h             gain, phase and delay margins of a loop
//   peak.h                the H-infinity norm (Bruinsma & Steinbuch 1990)
//   time_response.h       step and impulse responses, rise, overshoot and settling of a step
// Only the bracket of the norm is proved, in ball arithmetic (peak.h). Sizes are not checked.
#pragma once

#include <vector>

#include "numbers/matrix.h"

namespace gainsmith::response {

using numbers::Matrix;

struct StateSpace {
  Matrix A, B, C, D;  ///< n x n, n x m, p x n, p x m
  double step = 0;    ///< T, in the unit of time; 0: continuous

  Eigen::Index states() const { return A.rows(); }
  Eigen::Index inputs() const { return D.cols(); }
  Eigen::Index outputs() const { return D.rows(); }
  bool is_sampled() const { return step > 0; }
  bool is_single() const { return inputs() == 1 && outputs() == 1; }
};

/// The parts of `whole` = [A, B; C, D], (n + p) x (n + m), with n = `states`.
StateSpace state_space(const Matrix& whole, int states, double step);

/// T^-1 A T, T^-1 B, C T with T = diag(2^exponents), n exponents: the same H. Nothing is rounded,
/// as long as no element underflows.
StateSpace in_units(StateSpace system, const std::vector<int>& exponents);

/// A row (real part, imaginary part) for each; as numbers::real_eigenvalues orders them.
Matrix poles(const StateSpace& system);

/// The values of s, or z, at which [A - s I, B; C, D] has a smaller rank than for nearly all
/// others: of one input and one output the zeros of H that no pole cancels, and modes that are not
/// reached or not seen. A row (real part, imaginary part) for each, in no order; no rows without
/// states, inputs or outputs. By the reduction of Emami-Naeini and Van Dooren (Automatica 18,
/// 1982), so that zeros at infinity do not appear as large ones.
Matrix zeros(const StateSpace& system);

/// Whether all poles, as computed, are strictly left of the imaginary axis, or strictly inside of
/// the unit circle. True without states.
bool is_stable(const StateSpace& system);

/// y = H u with u - y for u, one output for one input: L/(1 + L). With g = 1/(1 + D) it is
///   A - g B C,  g B;  g C,  g D.
/// D = -1 makes it not finite.
StateSpace with_unit_feedback(const StateSpace& loop);

/// How a pole or zero s moves: its natural frequency |s| in radians per unit of time, and its
/// damping -Re s/|s|, which is 1 at s = 0. Of a sampled system s = log(z)/T; z = 0 is infinitely
/// fast.
struct Mode {
  double frequency = 0;
  double damping = 1;
};
Mode mode_of(double real, double imaginary, double step);

}  // namespace gainsmith::response
