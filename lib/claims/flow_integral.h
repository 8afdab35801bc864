// The integral over a flow of a function that is no quadratic form, such as norm(z - zh).
//
// A step of the flow is cut into pieces of length h; over each, with q the function along the flow,
//
//   |int q - h q(middle)| <= min(h^3/24 |q''|, h^2/4 |q'|, h |q - q(middle)|)
//
// (the midpoint rule; the second where q has a kink, the third where it jumps). q(middle) comes
// over balls from the state there; q, q' and q'' over the piece from jets (numbers/jet.h) of
//
//   x(s) = x_m +- (r + d |x_m'| + d^2/2 w),  x'(s) = x_m' +- (A r + d w),  x''(s) = M x'(s)
//
// with d = h/2, x_m' = M x_m + b, A = |M|, w = e^(A d) A (A (|x_m| + r) + |b|) >= |x''|.
#pragma once

#include <vector>

#include "claims/value.h"
#include "numbers/jet.h"

namespace gainsmith::claims {

template <class Scalar>
class FlowIntegral {
 public:
  FlowIntegral(const JudgedFunction& function, const bounded::BoundedSystem<Scalar>& system);
  FlowIntegral(FlowIntegral&&) noexcept = default;
  FlowIntegral& operator=(FlowIntegral&&) noexcept = default;

  /// Over a move of the track that is a flow. Its bound is infinite where none is known.
  bounded::Bounded<Scalar> operator()(const bounded::Track<Scalar>& track, std::size_t move);

 private:
  void advance(double length, int level);
  void enclose(double half, double timer, double timer_bound);

  const bounded::BoundedSystem<Scalar>* system_;
  bounded::BallFunction<Scalar> at_middle_;
  numbers::Matrix flow_, sizes_;  ///< M and A, the elements below rounded once
  Eigen::VectorXd constant_, constant_sizes_;
  std::vector<hybrid::Slot> slots_;   ///< those that the function uses
  std::vector<numbers::Jet> moving_;  ///< theirs, then the timer's
  expr::Evaluator<numbers::JetAlgebra> over_piece_;
  bounded::ColumnOf<Scalar> x_;
  Eigen::VectorXd r_;
  numbers::MatrixOf<Scalar> added_;
};

}  // namespace gainsmith::claims
