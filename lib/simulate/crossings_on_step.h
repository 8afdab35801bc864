// Internal to hybrid: one border on a step, all its elements.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "hybrid/event_functions.h"
#include "ode/roots.h"
#include "simulate/step_values.h"

namespace gainsmith::simulate {

class CrossingsOnStep {
 public:
  /// Both must outlive it.
  CrossingsOnStep(hybrid::EventFunction& border, StepPoints& points);

  /// `near`: of the terms, as RootFunction::near.
  ode::Found roots(Eigen::Index element, bool strict, double near = 0);
  double value(Eigen::Index element, double t);
  /// The part of the step after which an element turns back that starts within its noise and has
  /// hardly left it, so that a root may lie in the noise; of an element whose first slope is noise
  /// the shortest. None where all of it is noise, or where its text branches.
  std::optional<double> hidden_turn(Eigen::Index element);
  /// Elements x points.times().
  const numbers::Matrix& values() const { return values_; }
  /// Of each element, what its terms may round to.
  const Eigen::VectorXd& noise() const { return noise_; }

 private:
  hybrid::EventFunction& border_;
  StepPoints& points_;
  numbers::Matrix values_;
  Eigen::VectorXd noise_;
  std::vector<ode::Break> breaks_;
};

}  // namespace gainsmith::simulate
