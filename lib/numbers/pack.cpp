#include "numbers/pack.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "numbers/real.h"

namespace gainsmith::numbers {

namespace {

using Eigen::Index;
using expr::Instruction;
using expr::Op;
using Operands = std::span<const Pack* const>;

/// out = f(a, b) for element `ea` of a and `eb` of b, of which at least one moves.
template <class F>
void combine(const Pack& a, Index ea, const Pack& b, Index eb, Eigen::Ref<Eigen::ArrayXd> out,
             F f) {
  const auto number = [](const Pack& pack, Index e) {
    return Eigen::ArrayXd::Constant(Pack::kLanes, pack.matrix(e));
  };
  if (a.same) {
    out = f(number(a, ea), b.lanes.col(eb));
  } else if (b.same) {
    out = f(a.lanes.col(ea), number(b, eb));
  } else {
    out = f(a.lanes.col(ea), b.lanes.col(eb));
  }
}

template <class F>
void element_by_element(const Pack& a, const Pack& b, Pack& out, F f) {
  for (Index e = 0; e < out.lanes.cols(); ++e) combine(a, e, b, e, out.lanes.col(e), f);
}

/// out(i, j) = sum over k of a(i, k) b(k, j), in the order of k.
void multiply(const Pack& a, const Pack& b, Pack& out) {
  out.lanes.setZero();
  for (Index j = 0; j < out.cols; ++j) {
    for (Index i = 0; i < out.rows; ++i) {
      auto sum = out.lanes.col(i + j * out.rows);
      for (Index k = 0; k < a.cols; ++k)
        combine(a, i + k * a.rows, b, k + j * b.rows, sum,
                [&](const auto& x, const auto& y) { return sum + x * y; });
    }
  }
}

void transpose(const Pack& a, Pack& out) {
  for (Index j = 0; j < out.cols; ++j)
    for (Index i = 0; i < out.rows; ++i)
      out.lanes.col(i + j * out.rows) = a.lanes.col(j + i * a.rows);
}

/// Any instruction, point by point, by the arithmetic of doubles.
void point_by_point(const Instruction& instruction, Operands operands, Pack& out) {
  std::vector<Matrix> values;
  std::vector<const Matrix*> pointers;
  for (const Pack* operand : operands) values.push_back(operand->matrix);
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i].resize(operands[i]->rows, operands[i]->cols);
    pointers.push_back(&values[i]);
  }
  Matrix result;
  for (Index lane = 0; lane < Pack::kLanes; ++lane) {
    for (std::size_t i = 0; i < values.size(); ++i)
      if (!operands[i]->same) values[i].reshaped() = operands[i]->lanes.row(lane).transpose();
    try {
      RealAlgebra{}.apply(instruction, pointers, result);
      out.lanes.row(lane) = result.reshaped().transpose();
    } catch (const expr::EvaluationError&) {
      out.lanes.row(lane).setConstant(std::numeric_limits<double>::quiet_NaN());
    }
  }
}

void compute_once(const Instruction& instruction, Operands operands, Pack& out) {
  std::vector<const Matrix*> pointers;
  for (const Pack* operand : operands) pointers.push_back(&operand->matrix);
  out.same = true;
  RealAlgebra{}.apply(instruction, pointers, out.matrix);
}

}  // namespace

Pack constant_pack(const Matrix& matrix) {
  return {true, matrix.rows(), matrix.cols(), matrix, {}};
}

void PackAlgebra::apply(const Instruction& instruction, Operands operands, Pack& out) const {
  out.rows = instruction.shape.rows;
  out.cols = instruction.shape.cols;
  if (std::all_of(operands.begin(), operands.end(), [](const Pack* pack) { return pack->same; })) {
    compute_once(instruction, operands, out);
    return;
  }
  out.same = false;
  out.lanes.resize(Pack::kLanes, instruction.shape.size());
  const auto a = [&]() -> const Pack& { return *operands[0]; };
  const auto b = [&]() -> const Pack& { return *operands[1]; };
  switch (instruction.op) {
    case Op::add:
      element_by_element(a(), b(), out, [](const auto& x, const auto& y) { return x + y; });
      break;
    case Op::subtract:
      element_by_element(a(), b(), out, [](const auto& x, const auto& y) { return x - y; });
      break;
    case Op::scale:
      for (Index e = 0; e < out.lanes.cols(); ++e)
        combine(a(), 0, b(), e, out.lanes.col(e),
                [](const auto& x, const auto& y) { return x * y; });
      break;
    case Op::divide:
      for (Index e = 0; e < out.lanes.cols(); ++e)
        combine(a(), e, b(), 0, out.lanes.col(e),
                [](const auto& x, const auto& y) { return x / y; });
      break;
    case Op::multiply:
      multiply(a(), b(), out);
      break;
    case Op::negate:
      out.lanes = -a().lanes;
      break;
    case Op::exp:
      out.lanes = a().lanes.exp();
      break;
    case Op::transpose:
      transpose(a(), out);
      break;
    default:
      point_by_point(instruction, operands, out);
  }
}

}  // namespace gainsmith::numbers
