// A program over a point in which its inputs are stacked, and its slope as the point moves:
//
//   f(p),   df = sum_k df/dp_k dp_k   over the inputs p_k that move,
//
// where each df/dp_k is an Op::jacobian, and all are one tape (stacked_functions.h).
#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "numbers/graph/stacked_functions.h"

namespace gainsmith::numbers {

class MovingFunction {
 public:
  /// The program must outlive it. Each input has a place in the point, which has `size` elements;
  /// those for which `moves` is true may move.
  MovingFunction(const expr::Program& program, const PlaceOfInput& place,
                 const std::function<bool(const std::string&)>& moves, Eigen::Index size);
  MovingFunction(const MovingFunction&) = delete;
  MovingFunction& operator=(const MovingFunction&) = delete;

  /// The point, which must outlive what is asked of it.
  void go_to(const Eigen::VectorXd& point);
  /// EvaluationError where an operation has no result.
  const Matrix& value() { return of(0); }
  /// Adds `factor` times the slope, elements x directions, as the point moves by `moves`, a column
  /// a direction. EvaluationError where there is no derivative.
  void add_slope(double factor, const Matrix& moves, Eigen::Ref<Matrix> to);

 private:
  const Matrix& of(std::size_t k) {
    return is_known_ ? functions_->value(k) : functions_->at(k, *point_);
  }

  Values none_;
  std::deque<expr::Program> derivatives_;
  std::vector<Eigen::Index> places_;  ///< of the inputs that move
  std::optional<StackedFunctions> functions_;
  const Eigen::VectorXd* point_ = nullptr;
  bool is_known_ = false;
};

}  // namespace gainsmith::numbers
