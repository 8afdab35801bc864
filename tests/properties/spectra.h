// Matrices with known eigenvalues.
#pragma once

#include "properties/draw.h"

namespace gainsmith::tests::properties {

/// Block upper triangular n x n with small whole numbers above its diagonal blocks: 1 x 1 with a
/// real eigenvalue, or [a, b; -b, a] with a +- ib. The largest real part is `worst`, all others are
/// in [-3, -0.2] - slack.
ExactMatrix continuous_spectrum(Draw& draw, int n, const Exact& worst, const Exact& slack = 0);

/// The same with `worst` the largest modulus and all others at most 0.9; the blocks r [c, s; -s, c]
/// have c^2 + s^2 = 1 from a Pythagorean triple.
ExactMatrix discrete_spectrum(Draw& draw, int n, const Exact& worst);

/// T^-1 A T.
inline ExactMatrix similar(const Coordinates& to, const ExactMatrix& A) {
  return to.inverse * A * to.T;
}

}  // namespace gainsmith::tests::properties
