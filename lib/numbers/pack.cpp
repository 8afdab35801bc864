#include "numbers/pack.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "numbers/real.h"

namespace gainsmith::numbers {

namespace {

using Eigen::Index;
using expr::Instruction;
using expr::Is;
using expr::Op;
using Operands = expr::Operands<Pack>;
using At = expr::Step<Pack>;

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

/// At least one operand moves; `out` has its shape.
struct PackRules {
  void operator()(Is<Op::add>, const At& at, Pack& out) const {
    element_by_element(at[0], at[1], out, [](const auto& x, const auto& y) { return x + y; });
  }
  void operator()(Is<Op::subtract>, const At& at, Pack& out) const {
    element_by_element(at[0], at[1], out, [](const auto& x, const auto& y) { return x - y; });
  }
  void operator()(Is<Op::scale>, const At& at, Pack& out) const {
    for (Index e = 0; e < out.lanes.cols(); ++e)
      combine(at[0], 0, at[1], e, out.lanes.col(e),
              [](const auto& x, const auto& y) { return x * y; });
  }
  void operator()(Is<Op::divide>, const At& at, Pack& out) const {
    for (Index e = 0; e < out.lanes.cols(); ++e)
      combine(at[0], e, at[1], 0, out.lanes.col(e),
              [](const auto& x, const auto& y) { return x / y; });
  }
  void operator()(Is<Op::multiply>, const At& at, Pack& out) const { multiply(at[0], at[1], out); }
  void operator()(Is<Op::negate>, const At& at, Pack& out) const { out.lanes = -at[0].lanes; }
  void operator()(Is<Op::exp>, const At& at, Pack& out) const { out.lanes = at[0].lanes.exp(); }
  void operator()(Is<Op::transpose>, const At& at, Pack& out) const { transpose(at[0], out); }

  template <Op op>
  requires expr::OneOf<
      op, Op::constant, Op::zeros, Op::fill, Op::identity, Op::power, Op::elementwise_product,
      Op::elementwise_quotient, Op::elementwise_power, Op::real_power, Op::floor, Op::mod,
      Op::atan2, Op::complement_basis, Op::jacobian, Op::blocks, Op::index, Op::inverse,
      Op::pseudo_inverse, Op::matrix_exponential, Op::log, Op::sqrt, Op::sin, Op::cos, Op::tanh,
      Op::abs, Op::sign, Op::minimum, Op::maximum, Op::where, Op::trace, Op::norm,
      Op::diagonal_matrix, Op::diagonal_of, Op::range_basis, Op::kernel_basis, Op::singular_values,
      Op::project_polytope, Op::project_ellipsoid, Op::project_affine, Op::project_convex,
      Op::flow_map, Op::extremum, Op::determinant, Op::eigenvalues, Op::continuous_riccati,
      Op::discrete_riccati>
  void operator()(Is<op>, const At& at, Pack& out) const {
    point_by_point(at.instruction, at.operands, out);
  }
};

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
  expr::dispatch(PackRules{}, instruction, operands, out);
}

}  // namespace gainsmith::numbers
