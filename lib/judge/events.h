// Internal to the judge (trajectory_judge.h): which events are due, at instants and inside flows.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "hybrid/trajectory.h"
#include "judge/clocks.h"
#include "judge/faults.h"
#include "judge/texts.h"

namespace gainsmith::judge {

/// Follows a trajectory part by part and remembers what each event has seen.
class JudgedEvents {
 public:
  JudgedEvents(JudgedTexts& texts, const hybrid::Trajectory& trajectory, Faults& faults);

  /// An instant with the values x, where `event` jumps next or nothing does: the events are looked
  /// at in order.
  void look(std::size_t part, double t, const Eigen::VectorXd& x, std::optional<std::size_t> event);
  void jumped(std::size_t part, const hybrid::JumpPoint& jump);
  /// A flow begins, and nothing was due.
  void flow(std::size_t part, const hybrid::FlowPiece& piece);
  void end(std::size_t part, double t);
  /// t, since, count, left, j of the run against what was seen.
  void check_numbers(std::size_t part, double t, const Eigen::VectorXd& x);

 private:
  struct Memory {
    int side = 0;        ///< of a border: on which e was last, for sure; 0 after its own jump
    bool spent = false;  ///< `when`: rejected by `if`, not due until its condition has been false
    std::optional<EventClock> clock;
    double last = 0;  ///< the time of the last jump
    std::int64_t count = 0;
    int lost_in_a_row = 0;
  };
  /// A point of a flow.
  struct Sample {
    double t = 0;
    Eigen::VectorXd x;
    Eigen::VectorXd sizes;  ///< of its step
  };

  Truth due(std::size_t event, double t, const Eigen::VectorXd& x, const Eigen::VectorXd& rounding);
  Truth without_if(std::size_t event, double t, const Eigen::VectorXd& x,
                   const Eigen::VectorXd& rounding);
  bool is_border(std::size_t event) const { return texts_.events[event].crossing.has_value(); }
  bool fires(std::size_t event, int from, int to) const;
  /// The sign of e, 0 where rounding hides it.
  int side(std::size_t event, const Eigen::VectorXd& x, const Eigen::VectorXd& rounding);
  void remember_side(std::size_t event, const Eigen::VectorXd& x, const Eigen::VectorXd& rounding);

  // judged_inside.cpp: the inside of flows.
  static std::vector<double> sample_times(const hybrid::FlowPiece& piece);
  std::vector<Sample> samples(const hybrid::FlowPiece& piece) const;
  Sample sample(const hybrid::FlowPiece& piece, double t) const;
  /// What holds at a point up to so many times its rounding.
  Truth inside(Guard& guard, const Sample& at, double times = 1);
  void watch_condition(const hybrid::FlowPiece& piece, const std::vector<Sample>& all, Guard& guard,
                       std::optional<std::size_t> event, const std::string& what);
  void watch_border(const hybrid::FlowPiece& piece, const std::vector<Sample>& all,
                    std::size_t event);
  void watch_clock(const hybrid::FlowPiece& piece, std::size_t event);
  /// Whether an occurrence at a point must jump: its `if` is true, for sure.
  bool must_jump(std::size_t event, const Sample& at);
  /// Where `value` is largest between two points on both sides of a point where it is larger; an
  /// early stop where it is > 0.
  double highest(double low, double high, const std::function<double(double)>& value) const;
  /// The first point, up to rounding, of (low, high] where `is_there` is.
  double entry(double low, double high, const std::function<bool(double)>& is_there) const;

  JudgedTexts& texts_;
  Faults& faults_;
  double horizon_;
  std::vector<Memory> memory_;
  std::size_t part_ = 0;
  std::int64_t jumps_ = 0;
};

}  // namespace gainsmith::judge
