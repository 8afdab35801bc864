// The branches that a flow takes (hybrid/switches.h), in one run.
//
// A branch is wrong once its D has been on the other side by more than a slack:
//
//   of kinks                1e-3 (relative * terms + absolute), a thousandth of the error of the
//                           integration; of exact flows the rounding of its terms
//   of signs and `where`    the rounding of its terms
//
// Then the flow ends at the last root of D before, and goes on with the other branch. Below the
// slack the wrong branch changes nothing. So neither rounding nor a flow along D = 0 ends a flow.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>

#include "simulate/event_watch.h"
#include "simulate/flow.h"

namespace gainsmith::simulate {

class Branches {
 public:
  /// All must outlive it.
  Branches(const hybrid::System& system, EventWatch& watch, const Accuracy& accuracy);

  /// Sets the branches for these values.
  void update(Eigen::VectorXd& values);
  /// The same of kinks alone.
  void update_kinks(Eigen::VectorXd& values);

  bool is_kink(std::size_t which) const;
  /// Of its first element among the values.
  Eigen::Index offset(std::size_t which) const;

  /// An element of a switch whose branch changes.
  struct Change {
    double t = 0;  ///< step.from: the whole step is on the other side
    Eigen::Index element = 0;
    double to = 0;  ///< 1 or -1
    std::size_t branch = 0;
  };
  /// The first on a step with the branches of `values`.
  std::optional<Change> first_change(const StepValues& inside, const Eigen::VectorXd& values);

  /// From now on errors count as absolute below this part of the accuracy's.
  void sharpen(double part) { part_ = part; }

 private:
  struct OnStep;
  /// Sets H of one switch: the sign of D, of a kink that of before where D is rounding.
  void update_one(std::size_t which, Eigen::VectorXd& values);
  /// The first change of one element from `branch`; none where D stays on its side up to the slack.
  std::optional<Change> change_of(std::size_t which, Eigen::Index element, double branch,
                                  OnStep& on_step);

  const hybrid::System* system_;
  EventWatch* watch_;
  double relative_, absolute_;
  double part_ = 1;
};

}  // namespace gainsmith::simulate
