#include "hybrid/affine.h"

#include <algorithm>
#include <vector>

namespace gainsmith::hybrid {

namespace {

using expr::Instruction;
using expr::Op;

constexpr int kNotAffine = 2;

/// The degree of one value from the degrees of its operands, at most kNotAffine.
int degree_of(const Instruction& instruction, const std::vector<int>& operands) {
  const int largest = operands.empty() ? 0 : *std::max_element(operands.begin(), operands.end());
  if (largest == 0) return 0;
  switch (instruction.op) {
    case Op::fill:
    case Op::identity:
    case Op::add:
    case Op::subtract:
    case Op::negate:
    case Op::transpose:
    case Op::blocks:
    case Op::index:
    case Op::trace:
    case Op::diagonal_matrix:
    case Op::diagonal_of:
      return largest;
    case Op::multiply:
    case Op::scale:
      return std::min(kNotAffine, operands[0] + operands[1]);
    case Op::divide:
      return operands[1] == 0 ? operands[0] : kNotAffine;
    case Op::power:
      return instruction.attributes[0] == 1 ? largest : kNotAffine;
    case Op::where:
      return operands[0] == 0 ? largest : kNotAffine;
    default:
      return kNotAffine;
  }
}

}  // namespace

const Instruction* first_not_affine(const expr::Program& program,
                                    const std::function<bool(const std::string&)>& moves) {
  std::vector<int> degrees;
  std::vector<int> operands;
  for (const Instruction& instruction : program.code) {
    if (instruction.op == Op::input) {
      const auto input = static_cast<std::size_t>(instruction.attributes[0]);
      degrees.push_back(moves(program.inputs[input].name) ? 1 : 0);
      continue;
    }
    operands.clear();
    for (const int operand : instruction.operands)
      operands.push_back(degrees[static_cast<std::size_t>(operand)]);
    degrees.push_back(degree_of(instruction, operands));
    if (degrees.back() == kNotAffine) return &instruction;
  }
  return nullptr;
}

AffineMap sample_affine(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& map,
                        Eigen::Index size) {
  AffineMap result{numbers::Matrix(size, size), map(Eigen::VectorXd::Zero(size))};
  for (Eigen::Index i = 0; i < size; ++i)
    result.linear.col(i) = map(Eigen::VectorXd::Unit(size, i)) - result.constant;
  return result;
}

}  // namespace gainsmith::hybrid
