// When two runs, of which one is moved in its last places or more accurate, have parted: what they
// differ by in a variable is no error any more, as they have nothing to do with each other.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "hybrid/state_layout.h"

namespace gainsmith::claims {

class Parting {
 public:
  /// From the values at the start on, n variables. `relative`, `absolute`: to which the runs are
  /// integrated.
  Parting(const Eigen::VectorXd& start, double relative, double absolute);

  /// The first variables have been computed from terms of these sizes; those of size 0 have not.
  void compute(const Eigen::VectorXd& terms);
  /// The variables of one slot are differences of those of another: what these are, they are made of.
  void relate(const hybrid::Slot& difference, const hybrid::Slot& from);
  /// The values of both at a time, in order of time.
  void see(double t, const Eigen::VectorXd& own, const Eigen::VectorXd& other);

  /// By variable, n x 1: from when on they differ by more than a thousandth of its range so far, and
  /// by more than a thousand times the accuracy of what it is computed from; infinite: never.
  const Eigen::VectorXd& since() const { return since_; }
  /// Of its values so far.
  double range(Eigen::Index variable) const { return high_(variable) - low_(variable); }
  bool has_parted(Eigen::Index variable) const { return since_(variable) < kNever; }

 private:
  static constexpr double kNever = std::numeric_limits<double>::infinity();
  Eigen::VectorXd low_, high_, since_, terms_;
  std::vector<Eigen::Index> from_;  ///< by variable: that it is a difference of, or itself
  double relative_, absolute_;
};

}  // namespace gainsmith::claims
