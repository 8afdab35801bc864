#include "numbers/dense/definite.h"

#include <limits>

#include "numbers/dense/definite_rules.h"

namespace gainsmith::numbers {

double margin(const Matrix& M) {
  if (M.rows() == 0) return 1;
  if (!M.allFinite()) return std::numeric_limits<double>::quiet_NaN();
  const double least = M.diagonal().minCoeff();
  if (!(least > 0)) return least == 0 ? 0 : -1;
  const Vector units = M.diagonal().cwiseSqrt().cwiseInverse();
  Matrix scaled = units.asDiagonal() * (0.5 * (M + M.transpose())) * units.asDiagonal();
  scaled.diagonal().setOnes();
  return symmetric_eigenvalues(scaled)(0);
}

template Definite definite<double>(const Enclosed<double>&);
template bool is_positive_definite<double>(const Enclosed<double>&, const Matrix&);

}  // namespace gainsmith::numbers
