// Internal to the judge (judge.h): which events are due, at instants and inside flows.
//
// An event is due, surely not due, or perhaps due within rounding (Truth). A fault needs certainty:
// a jump that is surely not due, or an event that is surely due and does not jump.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "hybrid/trajectory.h"
#include "judge/faults.h"
#include "judge/inside.h"
#include "judge/texts.h"

namespace gainsmith::judge {

/// Follows a trajectory part by part and remembers what each event has seen.
class EventCheck {
 public:
  EventCheck(const EventCheck&) = delete;  // parts point to others
  EventCheck& operator=(const EventCheck&) = delete;
  EventCheck(Texts& texts, const hybrid::Trajectory& trajectory, Faults& faults);

  /// An instant with the values x, where `event` jumps next or nothing does: the events are asked
  /// in order.
  void instant(std::size_t part, double t, const Eigen::VectorXd& x,
               std::optional<std::size_t> event);
  /// A jump has been checked: counts, losses in a row, clocks and sides follow it.
  void jumped(std::size_t part, const hybrid::JumpPoint& jump);
  /// A flow begins, and nothing was due.
  void flow(std::size_t part, const hybrid::FlowPiece& piece);
  /// The run ends at t.
  void end(std::size_t part, double t);
  /// t, since, count, left, j of the run against what was seen.
  void check_numbers(std::size_t part, double t, const Eigen::VectorXd& x);

 private:
  /// Of the occurrence and its `if` together.
  Truth due(std::size_t event, double t, const Eigen::VectorXd& x, const Eigen::VectorXd& rounding);
  /// Of the occurrence alone: a clock, a condition, or a change of sign since the last side that
  /// was certain.
  Truth without_if(std::size_t event, double t, const Eigen::VectorXd& x,
                   const Eigen::VectorXd& rounding);
  bool has_crossing(std::size_t event) const { return texts_.events[event].crossing.has_value(); }
  double crossing(std::size_t event, const Eigen::VectorXd& x) {
    return (*texts_.events[event].crossing)(x)(0, 0);
  }
  /// Keeps the side where rounding does not hide it.
  void remember_side(std::size_t event, const Eigen::VectorXd& x, const Eigen::VectorXd& rounding);
  /// From the start or a jump on nothing of before counts. `at_zero`: if it led to exactly 0.
  void forget_side(std::size_t event, const Eigen::VectorXd& x, const Eigen::VectorXd& rounding,
                   bool at_zero);
  /// The side after a jump, of the event itself or of another one.
  void side_after(std::size_t event, const hybrid::JumpPoint& jump,
                  const Eigen::VectorXd& rounding);

  Texts& texts_;
  Faults& faults_;
  double horizon_;
  std::vector<EventMemory> memory_;
  FlowInside inside_;
  std::int64_t jumps_ = 0;
};

}  // namespace gainsmith::judge
