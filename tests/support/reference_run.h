// Trajectories written from closed forms, for the tests of those who judge them.
#pragma once

#include <functional>
#include <initializer_list>
#include <string>
#include <vector>

#include "hybrid/trajectory.h"
#include "judge/judge.h"
#include "model/dynamics.h"

namespace gainsmith::tests {

/// Writes one part after the other. All variables are stacked in the order of the dynamics.
class ReferenceRun {
 public:
  using Values = std::function<Eigen::VectorXd(double t)>;

  ReferenceRun(const Eigen::VectorXd& start, double horizon);

  /// A flow up to `to` in so many steps, from the values at their Chebyshev points.
  ReferenceRun& flow(double to, const Values& values, int steps = 4);
  /// Noise that is drawn for the next jump.
  ReferenceRun& draw(Eigen::Index element, double value);
  ReferenceRun& jump(std::size_t event, const Eigen::VectorXd& after, bool lost = false);
  hybrid::Trajectory end(hybrid::Ending ending = hybrid::Ending::horizon,
                         const std::string& message = "") const;

  double t() const { return t_; }
  const Eigen::VectorXd& x() const { return x_; }

 private:
  hybrid::Trajectory trajectory_;
  Eigen::VectorXd x_;
  double t_ = 0;
  std::int64_t j_ = 0;
};

/// The polynomial on [from, to] through the values at its Chebyshev points.
hybrid::DenseStep dense_step(double from, double to, const ReferenceRun::Values& values);

/// A column of these numbers.
Eigen::VectorXd column_of(std::initializer_list<double> values);

/// The place of a variable's first element.
Eigen::Index place_of(const model::Dynamics& dynamics, const std::string& variable);
std::size_t event_of(const model::Dynamics& dynamics, const std::string& name);

/// One line a fault.
std::string to_text(const std::vector<judge::Fault>& faults);
/// Whether a fault of that part says so.
bool has_fault(const std::vector<judge::Fault>& faults, std::size_t part, const std::string& what);

}  // namespace gainsmith::tests
