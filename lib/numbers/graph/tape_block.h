// An operation on matrices amid operations on numbers: what has no formula on numbers.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "numbers/graph/flow_map_evaluator.h"
#include "numbers/graph/tape_code.h"
#include "numbers/types/dual.h"

namespace gainsmith::numbers {

class TapeBlock {
 public:
  explicit TapeBlock(const TapeCode::Block& block);

  /// The value for the operands in registers, of which the k-th is registers[k*stride]. nullptr:
  /// there is none. What the same operands gave last is not computed again.
  const Matrix* operator()(const double* registers, std::size_t stride = 1);

 private:
  /// Computes out_ from operands_; false where there is no value.
  bool find_value();

  /// At an address that stays, where the evaluators have it from.
  std::unique_ptr<const expr::Instruction> instruction_;
  std::vector<std::vector<std::uint32_t>> from_;
  std::vector<Matrix> operands_;
  std::vector<const Matrix*> pointers_;
  bool is_slope_;
  Matrix out_;
  bool is_known_ = false;  ///< `out_` is the value for these operands
  std::unique_ptr<JacobianEvaluator<double>> jacobian_;
  std::unique_ptr<FlowMapEvaluator> flow_map_;
};

}  // namespace gainsmith::numbers
