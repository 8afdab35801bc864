// x' of coordinates between jumps: which elements are integrated, and their derivatives.
//
// A coordinate without a flow keeps its bits; one of a constant derivative (a clock) is start +
// rate t, with the rounding of that alone. All others are integrated.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "bounded/coordinates.h"
#include "hybrid/state_layout.h"

namespace gainsmith::bounded {

numbers::Values in_double(const numbers::ValuesOf<Decimal100>& values);

/// One for each thread. The coordinates and the constants must outlive it.
class FlowRate {
 public:
  FlowRate(const Coordinates& coordinates, const numbers::Values& constants);

  /// The elements that are integrated, in order.
  const std::vector<Eigen::Index>& elements() const { return elements_; }

  /// All elements, t after the start of a flow at `start`.
  void place(const Eigen::VectorXd& start, double t, const Eigen::VectorXd& moving,
             Eigen::VectorXd& x) const;
  /// The derivatives of the elements that are integrated; `timer`: at the start of the flow.
  void operator()(const Eigen::VectorXd& start, double timer, double t,
                  const Eigen::VectorXd& moving, Eigen::VectorXd& slope);

 private:
  std::vector<std::unique_ptr<hybrid::PointFunction>> flow_;  ///< of those that are integrated
  std::vector<Eigen::Index> elements_;
  Eigen::VectorXd clock_rates_;  ///< of all elements
  Eigen::VectorXd point_;        ///< where the flow is evaluated
};

}  // namespace gainsmith::bounded
