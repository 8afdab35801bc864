// Internal to hybrid: the branches that a flow holds (switches.h), in one run.
//
// A kink matters once its D has been on the other side than its branch by more than
//
//   slack = 1e-3 (relative * terms + absolute),   of exact flows: the rounding of its terms
//
// a thousandth of what the integration may be off. Then the flow is cut at the last root of D
// before, and goes on with the other branch; below it the wrong branch changes nothing. So neither
// rounding nor a flow along a kink makes cuts.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "hybrid/event_watch.h"
#include "hybrid/flow.h"

namespace gainsmith::hybrid {

class Branches {
 public:
  /// All must outlive it.
  Branches(const EventSystem& system, EventWatch& watch, const Accuracy& accuracy);

  /// Sets the branches for these values; whether one changes. `crossing`: at a border of one, where
  /// a sign of exactly 0 goes on to the other side.
  bool hold(Eigen::VectorXd& values, bool crossing);
  /// The same of kinks alone.
  void hold_kinks(Eigen::VectorXd& values);

  /// An element of a kink whose branch changes.
  struct Turn {
    double t = 0;  ///< step.from: the whole step is on the other side
    Eigen::Index held = 0;
  };
  /// The first on a step with the branches of `values`.
  std::optional<Turn> first_turn(const StepValues& inside, const Eigen::VectorXd& values);

  /// From now on errors count as absolute below this part of the accuracy's.
  void sharpen(double part) { part_ = part; }

 private:
  struct Look;
  bool is_kink(std::size_t one) const;
  bool hold_one(std::size_t one, Eigen::VectorXd& values, bool crossing);
  std::optional<double> turn_of(std::size_t kink, Eigen::Index element, double held, Look& look);
  Eigen::Index offset(std::size_t one) const;

  const EventSystem* system_;
  EventWatch* watch_;
  double relative_, absolute_;
  double part_ = 1;
};

}  // namespace gainsmith::hybrid
