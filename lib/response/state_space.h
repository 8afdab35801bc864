// A linear system with m inputs, n states and p outputs.
//
//   continuous   x' = A x + B u,  y = C x + D u,   H(s) = C (s I - A)^-1 B + D
//   sampled      x+ = A x + B u,  y = C x + D u,   H(z), z = exp(s T)
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

/// [A, B; C, D] with so many states.
StateSpace state_space(const Matrix& whole, int states, double step);

/// The same with 2^exponents as units of the states: nothing is rounded.
StateSpace in_units(StateSpace system, const std::vector<int>& exponents);

/// A row (real part, imaginary part) for each; as numbers::real_eigenvalues orders them.
Matrix poles(const StateSpace& system);

/// The values of s, or z, at which [A - s I, B; C, D] has a smaller rank than for nearly all others:
/// of one input and one output the zeros of H that no pole cancels, and modes that are not reached
/// or not seen. In no order. By the reduction of Emami-Naeini and Van Dooren (Automatica 18, 1982), so that zeros
/// at infinity do not appear as large ones.
Matrix zeros(const StateSpace& system);

/// Whether all poles are left of the imaginary axis, or inside of the unit circle.
bool is_stable(const StateSpace& system);

/// y = H u with u - y for u, one output for one input: L/(1 + L).
StateSpace with_unit_feedback(const StateSpace& loop);

/// How a pole or zero moves: its natural frequency in radians per unit of time, and its damping.
struct Mode {
  double frequency = 0;
  double damping = 1;
};
Mode mode_of(double real, double imaginary, double step);

}  // namespace gainsmith::response
