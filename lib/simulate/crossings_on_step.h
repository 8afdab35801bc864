// The zero crossings of one event function on a step, of all its elements.
//
// Roots of g(t) = e(x(t)) with x a Chebyshev series: ode/roots.h finds them on the pieces between
// breaks of e. At the start of a flow g is often 0 but for rounding, as after a jump at its root.
// There the sign of g says nothing, and its slope decides (hidden_turn, hidden_slope, leaves_zero).
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "hybrid/event_functions.h"
#include "ode/roots.h"
#include "simulate/step_values.h"

namespace gainsmith::simulate {

/// Whether all elements of a function without bounds stay away from 0 on a step, and from what
/// `near` says in CrossingsOnStep::roots: a polynomial of degree 4 does, by four times its distance
/// from the function between its points.
bool seems_apart(hybrid::EventFunction& function, const StepValues& inside, double near);

class CrossingsOnStep {
 public:
  /// All must outlive it. `times`: ode::first_points of the step.
  CrossingsOnStep(hybrid::EventFunction& function, const StepValues& inside,
                  const std::vector<double>& times);

  /// `near`: of the terms, as RootFunction::near.
  ode::Found roots(Eigen::Index element, bool strict, double near = 0);
  double value(Eigen::Index element, double t);
  /// Of an element that starts within its noise: the part of the step after which it turns back,
  /// where it has hardly left the noise, so that a root may lie in it. Where its first slope is
  /// noise, the shortest part; none where all of it is noise, or where its text branches.
  std::optional<double> hidden_turn(Eigen::Index element);
  /// Of an element that starts at exactly 0 and leaves it clearly: its first slope, as long as
  /// rounding may hide that it has left; 0 of others, and later.
  double hidden_slope(Eigen::Index element, double t);
  /// Of an element that starts as noise, its own or the `rounding` of the step before: when it ceases
  /// to be.
  std::optional<double> leaves_zero(Eigen::Index element, double rounding);
  /// Of each element, what its terms may round to.
  const Eigen::VectorXd& noise() const { return noise_; }

 private:
  /// Values at the points of an interpolant.
  Eigen::RowVectorXd on_points(Eigen::Index element);

  hybrid::EventFunction& function_;
  const StepValues& inside_;
  const std::vector<double>& times_;
  SomeValues used_;
  numbers::Matrix values_;  ///< elements x times
  std::vector<bool> is_known_;
  Eigen::VectorXd noise_;
  std::vector<ode::Break> breaks_;
};

}  // namespace gainsmith::simulate
