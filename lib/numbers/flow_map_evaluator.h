// Op::flow_map over doubles, of one instruction again and again.
#pragma once

#include <memory>

#include "expr/number_type.h"
#include "numbers/matrix.h"

namespace gainsmith::numbers {

/// What flow_map (flow_map.h) gives, up to rounding: the rate, and what it branches on, are tapes
/// that all calls share.
class FlowMapEvaluator {
 public:
  /// The instruction must outlive it.
  explicit FlowMapEvaluator(const expr::Instruction& instruction);
  FlowMapEvaluator(FlowMapEvaluator&&) noexcept;
  FlowMapEvaluator& operator=(FlowMapEvaluator&&) noexcept;
  ~FlowMapEvaluator();

  /// EvaluationError as flow_map.
  Matrix operator()(expr::Operands<Matrix> operands);

 private:
  struct Kept;
  std::unique_ptr<Kept> kept_;
};

}  // namespace gainsmith::numbers
