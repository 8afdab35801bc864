#include "lmi/correlation.h"

#include <algorithm>

#include "numbers/dense/dense.h"

namespace gainsmith::lmi {

double correlation_margin(const numbers::Matrix& M) {
  // The least M_ii / max_j |M_ij| of the rows whose diagonal element is not positive.
  double not_positive = 1;
  for (Eigen::Index i = 0; i < M.rows(); ++i) {
    if (!M.row(i).allFinite()) return -1;
    const double size = M.row(i).cwiseAbs().maxCoeff();
    if (!(M(i, i) > 0)) not_positive = std::min(not_positive, size > 0 ? M(i, i) / size : 0.0);
  }
  if (not_positive < 1) return not_positive;
  const numbers::Vector scale = M.diagonal().cwiseSqrt().cwiseInverse();
  numbers::Matrix scaled = scale.asDiagonal() * M * scale.asDiagonal();
  scaled.diagonal().setOnes();
  return numbers::smallest_eigenvalue(scaled);
}

}  // namespace gainsmith::lmi
