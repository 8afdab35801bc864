// What the variables are within one step.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "simulate/vector_field.h"

namespace gainsmith::simulate {

/// All values at times of one step.
/// x(t) for t in [from, to]: the start exactly, else the Chebyshev series and the lines of what is
/// steady.
class StepValues {
 public:
  /// `start`: the values at step.from, which a jump may have left at a zero crossing.
  StepValues(const VectorField& field, const Eigen::VectorXd& start, const hybrid::DenseStep& step)
      : field_(&field), start_(&start), step_(&step) {}

  Eigen::VectorXd at(double t) const;
  /// Where each of them lies all along the step: |T_k| <= 1.
  numbers::Box box() const;
  double from() const { return step_->from; }
  double to() const { return step_->to; }

 private:
  friend class SomeValues;
  const VectorField* field_;
  const Eigen::VectorXd* start_;
  const hybrid::DenseStep* step_;
};

/// Some of them alone: those that a function uses.
class SomeValues {
 public:
  /// `inside` must outlive it. Elements that are none of the variables rest.
  SomeValues(const StepValues& inside, const std::vector<Eigen::Index>& elements);

  /// The values at t, valid until the next call; the other elements are as at any time of the step.
  const Eigen::VectorXd& at(double t);

 private:
  StepValues inside_;
  std::vector<Eigen::Index> elements_;
  numbers::Matrix coefficients_;
  Eigen::VectorXd found_, values_;
};

}  // namespace gainsmith::simulate
