// When two runs, of which one is moved in its last places or more accurate, have parted: what they
// differ by in a variable is no error any more, as they have nothing to do with each other.
#pragma once

#include <Eigen/Core>
#include <limits>

namespace gainsmith::claims {

class Parting {
 public:
  /// From the values at the start on, n variables. `relative`, `absolute`: to which the runs are
  /// integrated.
  Parting(const Eigen::VectorXd& start, double relative, double absolute);

  /// The first variables have been computed from terms of these sizes; those of size 0 have not.
  void compute(const Eigen::VectorXd& terms);
  /// The values of both at a time, in order of time.
  void see(double t, const Eigen::VectorXd& own, const Eigen::VectorXd& other);

  /// By variable, n x 1: from when on they differ by more than a thousandth of its range so far, and
  /// by more than a thousand times the accuracy of what it is computed from; infinite: never.
  const Eigen::VectorXd& since() const { return since_; }
  bool has_parted(Eigen::Index variable) const { return since_(variable) < kNever; }

 private:
  static constexpr double kNever = std::numeric_limits<double>::infinity();
  Eigen::VectorXd low_, high_, since_, terms_;
  double relative_, absolute_;
};

}  // namespace gainsmith::claims
