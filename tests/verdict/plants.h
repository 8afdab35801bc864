// Plants whose eigenvalues are where a test wants them, and inequalities of Lyapunov for them.
#pragma once

#include <string>

#include "support/linear_algebra.h"
#include "support/yaml_problem.h"

namespace gainsmith::verdict {

inline std::string lyapunov(const numbers::Matrix& A) {
  return "  data: {A: n x n}\n  unknowns: {P: symmetric n}\n  require: {positive: P > 0, stable: "
         "He(P*A) < 0}\ndata: {A: " +
         tests::matrix_yaml(A) + "}\n";
}

/// A with the largest real part of an eigenvalue moved to `abscissa`.
inline numbers::Matrix with_abscissa(numbers::Matrix A, double abscissa) {
  const double found = tests::spectral_abscissa(A);
  A.diagonal().array() += abscissa - found;
  return A;
}

}  // namespace gainsmith::verdict
