#include "numbers/graph/tape_block.h"

#include <utility>

#include "numbers/dense/small_dense.h"
#include "numbers/graph/block_slope.h"
#include "numbers/types/real.h"

namespace gainsmith::numbers {

/// The slopes of a flow map follow its operands; one without columns does not move.
TapeBlock::TapeBlock(const TapeCode::Block& block)
    : instruction_(std::make_unique<const expr::Instruction>(block.instruction)),
      from_(block.operands),
      is_slope_(block.is_slope),
      out_(Matrix::Zero(block.instruction.shape.rows, block.instruction.shape.cols)) {
  for (const expr::Shape& shape : block.shapes)
    operands_.push_back(Matrix::Zero(shape.rows, shape.cols));
  for (const Matrix& operand : operands_) pointers_.push_back(&operand);
  if (instruction_->op == expr::Op::jacobian)
    jacobian_ = std::make_unique<JacobianEvaluator<double>>(*instruction_);
  if (instruction_->op == expr::Op::flow_map) {
    std::vector<bool> moves;
    for (std::size_t k = operands_.size() / 2; is_slope_ && k < operands_.size(); ++k)
      moves.push_back(operands_[k].cols() > 0);
    flow_map_ = std::make_unique<FlowMapEvaluator>(*instruction_, std::move(moves));
  }
}

/// Small matrices without allocation first (small_dense.h), then as Real does. A fault is no value:
/// who runs the tape evaluates over Real, which names it.
bool TapeBlock::find_value() {
  using expr::Op;
  const Op op = instruction_->op;
  try {
    if (is_slope_ && flow_map_ == nullptr) return block_slope(*instruction_, pointers_, out_);
    if (op == Op::inverse && small_inverse(operands_[0], out_.data())) return true;
    if (op == Op::singular_values && small_singular_values(operands_[0], out_.data())) return true;
    if (jacobian_ != nullptr) {
      out_ = (*jacobian_)(pointers_);
    } else if (flow_map_ != nullptr) {
      out_ = (*flow_map_)(pointers_);
    } else {
      RealAlgebra{}.apply(*instruction_, pointers_, out_);
    }
  } catch (const expr::EvaluationError&) {
    return false;
  }
  return true;
}

/// A NaN among the operands differs from itself, so that the value is found anew.
const Matrix* TapeBlock::operator()(const double* registers, std::size_t stride) {
  for (std::size_t k = 0; k < from_.size(); ++k) {
    double* to = operands_[k].data();
    for (const std::uint32_t from : from_[k]) {
      const double value = registers[from * stride];
      is_known_ = is_known_ && *to == value;
      *to++ = value;
    }
  }
  if (!is_known_) is_known_ = find_value();
  return is_known_ ? &out_ : nullptr;
}

}  // namespace gainsmith::numbers
