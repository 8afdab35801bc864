// The conditions under `while`, the flow sets, along one run: each has to remain true in a flow once
// it has been true there.
//
// A run that leaves its flow set without a jump that is due has no continuation, and ends.
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "simulate/event_watch.h"
#include "simulate/step_values.h"

namespace gainsmith::simulate {

class FlowSets {
 public:
  /// Which conditions have been true in this flow.
  using Marks = std::vector<bool>;

  /// The watch must outlive it.
  explicit FlowSets(EventWatch& watch) : watch_(&watch), inside_(watch.flow_sets.size(), true) {}

  /// A flow begins there.
  void begin(const Eigen::VectorXd& values);
  /// A jump to the boundary of a flow set may miss it by rounding: the flow has to lead inside by
  /// the time `soon`.
  /// RunEnd otherwise.
  void require_inside(const StepValues& inside, double soon);
  /// Whether a condition that was true is not any more.
  bool leaves(const Eigen::VectorXd& values);
  /// RunEnd of the first that is false.
  void leave_first(const Eigen::VectorXd& values);

  const Marks& marks() const { return inside_; }
  void set_marks(Marks marks) { inside_ = std::move(marks); }

 private:
  EventWatch* watch_;
  Marks inside_;
};

}  // namespace gainsmith::simulate
