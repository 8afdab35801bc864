// Internal to the judge (judge.h): when the events `every` and `at` are due.
//
//   at t_1, t_2, ...      occurrence k is t_k
//   every T               first + k T, by one product
//   every [low, high]     low <= t_(k+1) - t_k <= high, and the first within its own range
//
// Times of sums are compared up to time_rounding (faults.h).
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "judge/faults.h"
#include "judge/texts.h"

namespace gainsmith::judge {

/// The occurrences of one event. The next one is known for times that are given, for clocks of one
/// length, and where the run records what is left of the clock. Otherwise it is the next jump of the
/// event, and its distance from the last one must be a length.
class EventClock {
 public:
  /// `jumps`: the times of the event's jumps in the trajectory.
  EventClock(const Texts& texts, std::size_t event, std::vector<double> jumps,
             const Eigen::VectorXd& start, Faults& faults);

  /// Infinite: none any more.
  double next() const { return next_; }
  /// An occurrence at t: with a jump to `after`, or spent by `if`.
  void jumped(std::size_t part, double t, const Eigen::VectorXd& after);
  void spent(double t);
  /// A flow begins: what is left of a clock that was spent is seen here.
  void flow(std::size_t part, double t, const Eigen::VectorXd& x);
  /// Checks what is left of the clock against the next occurrence.
  void check_left(std::size_t part, double t, const Eigen::VectorXd& x);
  /// The end of the run: a clock that is still running is not too long.
  void end(std::size_t part, double t);

 private:
  bool is_given() const { return kind_ == model::Dynamics::EventKind::at; }
  bool has_one_length() const { return texts_.low == texts_.high; }
  /// The next occurrence after one at t.
  void reset(double t);
  /// The time since the last jump against the range; with an `if` it has no upper bound.
  void check_length(std::size_t part, double t);
  /// What is left of the clock, by the variable event.left.
  double left(const Eigen::VectorXd& x) const;

  const Texts& all_;
  const EventTexts& texts_;
  model::Dynamics::EventKind kind_;
  std::string name_;
  bool conditional_;                    ///< has an `if`, so that occurrences may leave no trace
  std::optional<std::size_t> left_of_;  ///< the variable
  std::vector<double> jumps_;
  Faults& faults_;

  std::size_t done_ = 0;         ///< jumps so far
  std::size_t occurrences_ = 0;  ///< with those that were spent
  std::optional<double> base_;   ///< of one length: the first occurrence
  double last_ = 0;              ///< the time of the last jump, 0 before it
  double next_ = 0;
  bool unseen_ = false;  ///< spent, and what is left now not seen yet
};

}  // namespace gainsmith::judge
