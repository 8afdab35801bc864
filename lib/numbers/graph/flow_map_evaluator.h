// Op::flow_map over doubles, of one instruction again and again.
#pragma once

#include <memory>
#include <vector>

#include "expr/program/number_type.h"
#include "numbers/matrix.h"

namespace gainsmith::numbers {

/// What flow_map and flow_map_slope (flow_map.h) give, up to rounding: the rate, and what it
/// branches on, are tapes that all calls share.
class FlowMapEvaluator {
 public:
  /// The instruction must outlive it. `moves`: by operand, whether it moves; empty: none does, and
  /// no slope is asked for.
  explicit FlowMapEvaluator(const expr::Instruction& instruction, std::vector<bool> moves = {});
  FlowMapEvaluator(FlowMapEvaluator&&) noexcept;
  FlowMapEvaluator& operator=(FlowMapEvaluator&&) noexcept;
  ~FlowMapEvaluator();

  /// The value. Where slopes are asked for, the operands are followed by their slopes (elements x
  /// directions; of what does not move it is not read), and it is a column, with a column for each
  /// direction beside it. EvaluationError as flow_map, and where there is no slope.
  Matrix operator()(expr::Operands<Matrix> operands);

 private:
  struct Kept;
  std::unique_ptr<Kept> kept_;
};

}  // namespace gainsmith::numbers
