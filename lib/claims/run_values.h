// Values of texts along a run of dynamics with events.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "hybrid/breaks.h"
#include "hybrid/trajectory.h"
#include "numbers/graph/stacked_functions.h"

namespace gainsmith::claims {

/// A text as a function of all variables. The layout, the constants and the program must outlive
/// it.
class RunValue {
 public:
  /// `program` without calls.
  RunValue(const expr::Program& program, const hybrid::StateLayout& layout,
           const numbers::Values& constants);

  /// Not a number where it has no value.
  const numbers::Matrix& operator()(const Eigen::VectorXd& x);
  /// The same of a 1 x 1 text.
  double number(const Eigen::VectorXd& x);

  /// How far the computed value at x may be from the true one, constants being decimals that are
  /// rounded once; none: no bound is known.
  std::optional<double> rounding(const Eigen::VectorXd& x);

  /// From now on at() and breaks() are along this step: the variables that it uses are computed
  /// alone.
  void follow(const hybrid::DenseStep& step);
  /// Bounds of the value all along the step; none: they are not known, or it may have no value.
  std::optional<numbers::Range> range();
  /// The value at t in the step.
  double at(double t) { return number(point(t)); }
  /// At t all variables that it uses; others are 0.
  const Eigen::VectorXd& point(double t);
  /// The elements of the variables that it uses.
  const std::vector<Eigen::Index>& used() const { return used_; }
  /// Of each of them, the sum of the sizes of its coefficients.
  Eigen::VectorXd sizes() const { return followed_.cwiseAbs().rowwise().sum(); }

  /// Whether it is smooth along every flow.
  bool is_smooth() const { return breaks_.none(); }
  /// Where it is not, on a step: Breaks::on.
  std::optional<std::vector<ode::Break>> breaks(std::vector<double>* near = nullptr) {
    return breaks_.on([this](double t) -> const Eigen::VectorXd& { return point(t); }, from_, to_,
                      breaks_.none() ? numbers::Box() : box(), near);
  }
  /// Until when, in a run, its breaks can be searched.
  double followed_until = std::numeric_limits<double>::infinity();
  /// What is 0 there.
  std::vector<const expr::Program*> differences() const { return breaks_.differences(); }
  /// Breaks::is_far of the k-th.
  bool is_far(std::size_t k, const Eigen::VectorXd& x, const Eigen::VectorXd& r, double times) {
    return breaks_.is_far(k, x, r, times);
  }

 private:
  /// Where the variables lie all along the step: |T_k| <= 1.
  numbers::Box box() const;

  numbers::StackedFunctions function_;
  hybrid::Breaks breaks_;
  numbers::Matrix none_;
  std::vector<Eigen::Index> used_;
  double from_ = 0, to_ = 0;
  numbers::Matrix followed_;  ///< coefficients of what is used
  Eigen::VectorXd used_values_, point_;
  numbers::Box here_;  ///< of no width
};

/// A moment of a run.
struct Moment {
  double t = 0;
  std::int64_t j = 0;
  const hybrid::JumpPoint* jump = nullptr;  ///< just after it
  Eigen::VectorXd x;
};

/// Visits the start, the ends of all flows, points between them and the states after jumps, in
/// order. The points are the multiples of `step`. When it is 0, they are the ends of the steps of
/// the integration and their middles.
void visit(const hybrid::Trajectory& run, double step,
           const std::function<void(const Moment&)>& seen);

/// Visits the steps of all flows in order.
void visit_steps(const hybrid::Trajectory& run,
                 const std::function<void(const hybrid::DenseStep&)>& seen);

}  // namespace gainsmith::claims
