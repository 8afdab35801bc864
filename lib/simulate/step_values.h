// What the variables are within one step.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "simulate/vector_field.h"

namespace gainsmith::simulate {

/// All values at times of one step.
class StepValues {
 public:
  /// `start`: the values at step.from, which a jump may have left at a zero crossing.
  StepValues(const VectorField& field, const Eigen::VectorXd& start, const hybrid::DenseStep& step)
      : field_(&field), start_(&start), step_(&step) {}

  Eigen::VectorXd at(double t) const;
  double from() const { return step_->from; }
  double to() const { return step_->to; }

 private:
  const VectorField* field_;
  const Eigen::VectorXd* start_;
  const hybrid::DenseStep* step_;
};

/// The values at the points at which every search for roots begins, made when they are asked for.
class StepPoints {
 public:
  explicit StepPoints(const StepValues& inside) : inside_(&inside) {}

  const StepValues& inside() const { return *inside_; }
  const std::vector<double>& times();
  const std::vector<Eigen::VectorXd>& values();

 private:
  const StepValues* inside_;
  std::vector<double> times_;
  std::vector<Eigen::VectorXd> values_;
};

}  // namespace gainsmith::simulate
