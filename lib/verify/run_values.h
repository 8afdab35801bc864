// Values of texts along a run of dynamics with events.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "hybrid/breaks.h"
#include "hybrid/trajectory.h"
#include "model/stated.h"

namespace gainsmith::verify {

/// A text as a function of all variables. The layout, the constants and the program must outlive
/// it.
class RunValue {
 public:
  /// `program` without calls.
  RunValue(const expr::Program& program, const hybrid::StateLayout& layout,
           const numbers::Values& constants);

  /// Not a number where it has no value.
  const numbers::Matrix& operator()(const Eigen::VectorXd& x);
  double number(const Eigen::VectorXd& x) { return (*this)(x)(0, 0); }

  /// Whether it is smooth along every flow.
  bool is_smooth() const { return breaks_.none(); }
  /// Where it is not, on a step.
  std::vector<hybrid::Break> breaks_on(const hybrid::DenseStep& step,
                                       std::vector<double>* near = nullptr) {
    return breaks_.on(step, step.from, step.to, near);
  }
  /// What is 0 there.
  std::vector<const expr::Program*> differences() const { return breaks_.differences(); }
  /// Breaks::distance of the k-th.
  double distance(std::size_t k, const Eigen::VectorXd& x, const Eigen::VectorXd& r) {
    return breaks_.distance(k, x, r);
  }

 private:
  hybrid::PointFunction function_;
  hybrid::Breaks breaks_;
  numbers::Matrix none_;
};

/// A moment of a run.
struct Moment {
  double t = 0;
  std::int64_t j = 0;
  const hybrid::JumpPoint* jump = nullptr;  ///< just after it
  Eigen::VectorXd x;
};

/// Visits the start, the ends of all flows, points between them and the states after jumps, in
/// order: the points that are multiples of `step`, or, when it is 0, the ends of the steps of the
/// integration and their middles.
void visit(const hybrid::Trajectory& run, double step,
           const std::function<void(const Moment&)>& seen);

/// Visits the steps of all flows in order.
void visit_steps(const hybrid::Trajectory& run,
                 const std::function<void(const hybrid::DenseStep&)>& seen);

}  // namespace gainsmith::verify
