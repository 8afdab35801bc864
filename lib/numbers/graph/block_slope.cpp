#include "numbers/graph/block_slope.h"

#include <cstddef>
#include <vector>

#include "numbers/dense/foundation.h"
#include "numbers/dense/small_dense.h"
#include "numbers/types/dual.h"

namespace gainsmith::numbers {

namespace {

using expr::Op;

/// u' dM v for each pair of singular vectors.
void singular_slopes(const Matrix& M, const Matrix& dM, Matrix& slope) {
  slope.resize(std::min(M.rows(), M.cols()), 1);
  if (small_singular_slopes(M, dM, slope.data())) return;
  const auto svd = Foundation<double>::full_svd(M);
  for (Eigen::Index i = 0; i < slope.size(); ++i)
    slope(i) = svd.s(i) == 0 ? 0 : svd.U.col(i).dot(dM * svd.V.col(i));
}

}  // namespace

bool has_block_slope(Op op) {
  using enum Op;
  return is_one_of(op,
                   {singular_values, determinant, pseudo_inverse, multiply, power, project_convex});
}

bool block_slope(const expr::Instruction& instruction, expr::Operands<Matrix> operands,
                 Matrix& slope) {
  const std::size_t count = operands.size() / 2;
  for (const Matrix* operand : operands)
    if (!operand->allFinite()) return false;
  if (instruction.op == Op::singular_values) {
    singular_slopes(*operands[0], *operands[1], slope);
    return true;
  }
  std::vector<Dual<double>> moving(count);
  std::vector<const Dual<double>*> pointers;
  for (std::size_t k = 0; k < count; ++k) {
    moving[k] = {*operands[k], operands[count + k]->reshaped(), {}};
    pointers.push_back(&moving[k]);
  }
  Dual<double> out;
  DualNumbers<double>{}.apply(instruction, pointers, out);
  slope = out.slope.reshaped(out.value.rows(), out.value.cols());
  return !out.without;
}

}  // namespace gainsmith::numbers
