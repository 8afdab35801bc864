// Where a text along a flow is not smooth: where what it branches on (expr/program/branches.h)
// comes to 0. That may branch itself: its roots are searched on the pieces between the breaks
// before it, where it is smooth. So a branch is found however short it is taken.
//
// A break is a bracket [left, right] of one root of such a D. It says whether the text jumps there
// or has a kink.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "hybrid/state_layout.h"
#include "ode/roots.h"

namespace gainsmith::hybrid {

/// Texts are split once, when it is made: each branch is one program D that is 0 where the branch
/// changes.
class Breaks {
 public:
  /// The constants must outlive it.
  Breaks(const expr::Program& program, const StateLayout& layout, const numbers::Values& constants,
         const std::function<bool(const std::string&)>& moves);

  /// Whether it is smooth everywhere.
  bool none() const { return texts_.empty(); }

  /// In rising order, each once, on a step over which `x` is smooth and lies in `box`. Where a
  /// difference has no value, or is 0 all along but for rounding, nothing is found. None where
  /// there are more than can be searched (Found::whole). `near` takes the places where a difference
  /// comes near 0, by a 50th of its largest size on the step, and turns back.
  std::optional<std::vector<ode::Break>> on(const std::function<const Eigen::VectorXd&(double)>& x,
                                            double from, double to, const numbers::Box& box,
                                            std::vector<double>* near = nullptr);

  /// What is 0 at a break.
  std::vector<const expr::Program*> differences() const;

  /// The k-th difference over its change when the variables change by r up or down, or over the
  /// rounding of its terms where that is more; the least of its elements. An estimate from some
  /// such changes, and no bound. Infinite where it has no value, or where nothing changes it.
  double distance(std::size_t k, const Eigen::VectorXd& x, const Eigen::VectorXd& r);
  /// Whether the distance is above `times`; intervals tell it of most.
  bool is_far(std::size_t k, const Eigen::VectorXd& x, const Eigen::VectorXd& r, double times);

 private:
  struct Text {
    std::unique_ptr<const expr::Program> program, terms_program;
    PointFunction value, terms;  ///< D, and the sums of the absolute values of its terms
    bool jumps = false, waves = false;
  };

  std::vector<Text> texts_;
  numbers::Box box_;  ///< around a point
};

/// Whether it may turn more often along a step than the variables do: sines, exponentials and the
/// like of them. Then some of its values say nothing of those between them.
bool may_wave(const expr::Program& program);

}  // namespace gainsmith::hybrid
