// The stacked state of a hybrid system and functions of it.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "expr/evaluate.h"
#include "expr/program.h"
#include "model/design.h"
#include "numbers/real.h"

namespace gainsmith::hybrid {

/// One named state inside the stacked vector: its elements column by column from `offset`.
struct Slot {
  std::string name;
  expr::Shape shape;
  Eigen::Index offset = 0;
};

/// How the named states are stacked to x in R^size: plant first, then observer, in the method's
/// order.
struct StateLayout {
  std::vector<Slot> slots;
  Eigen::Index size = 0;
  std::string timer;

  /// Whether a name stands for a state or the timer, so that its value changes along a run.
  bool moves(const std::string& name) const;
};

StateLayout make_layout(const std::vector<model::Design::State>& states, const std::string& timer);

/// A program as a function of (x, tau), one point at a time. The program and the constants must
/// outlive it; every input must be a state, the timer or a constant.
class PointFunction {
 public:
  PointFunction(const expr::Program& program, const StateLayout& layout,
                const numbers::Values& constants);
  PointFunction(PointFunction&&) = default;  // a copy's evaluator would point into the original
  PointFunction& operator=(PointFunction&&) = default;

  /// The value; it stands until the next call. InputError when an operation has no result.
  const numbers::Matrix& operator()(const Eigen::VectorXd& x, double tau);

 private:
  std::vector<Slot> slots_;
  std::vector<numbers::Matrix> moving_;  ///< the states, then the timer
  expr::Evaluator<numbers::RealAlgebra> evaluator_;
};

}  // namespace gainsmith::hybrid
