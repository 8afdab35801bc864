// Expressions along an arc, at many points at once and in double: what a person looks at.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "expr/evaluate.h"
#include "hybrid/system.h"
#include "numbers/pack.h"

namespace gainsmith::verify {

/// A program as a function of (x, tau) at many points. The program and the system must outlive it;
/// every input must be a state, the timer or a constant of the system.
class AlongFunction {
 public:
  AlongFunction(const expr::Program& program, const hybrid::System& system);
  AlongFunction(AlongFunction&&) = default;  // a copy's evaluator would point into the original
  AlongFunction& operator=(AlongFunction&&) = default;

  /// states: size x N, timers: N. The result is elements x N, the value's elements column by
  /// column; it holds infinities or NaNs where the value is none. InputError when a part that does
  /// not move along the arc has no value.
  numbers::Matrix operator()(const Eigen::Ref<const numbers::Matrix>& states,
                             const Eigen::Ref<const Eigen::VectorXd>& timers);

 private:
  std::vector<hybrid::Slot> slots_;  ///< the states that the program uses
  bool uses_timer_;
  std::vector<numbers::Pack> constants_;
  std::vector<numbers::Pack> moving_;  ///< those states, then the timer
  expr::Evaluator<numbers::PackAlgebra> evaluator_;
  Eigen::Index elements_;
};

}  // namespace gainsmith::verify
