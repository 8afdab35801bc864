// Internal to the judge (judge.h): what must not happen inside of flows. No condition of an event is
// true there, no event function crosses zero, no clock runs down, and no flow set is left.
//
// A flow is sampled at 16 Chebyshev points a step, and at distances 4^-k, down to k = 24, of its
// first and last step from its two ends. Between samples an extremum that may reach 0 is searched
// by golden section, and the entry to a true condition by bisection. This finds what the simulator
// missed, and is no proof that nothing is there.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "hybrid/trajectory.h"
#include "judge/clocks.h"
#include "judge/faults.h"
#include "judge/texts.h"

namespace gainsmith::judge {

/// What one event has seen so far.
struct EventMemory {
  int side = 0;            ///< of a crossing: on which e was last, for sure; 0 after its own jump
  bool at_zero = false;    ///< the start or a jump led e to exactly 0, and it has not left it
  bool near_zero = false;  ///< a jump led e to 0 up to rounding, and it has not left that
  /// `when`: rejected by `if`, not due until its condition has been false. Of a crossing: it has
  /// left e at 0, up to rounding, and nothing has changed that.
  bool spent = false;
  std::optional<EventClock> clock;
  double last = 0;  ///< the time of the last jump
  std::int64_t count = 0;
  int lost_in_a_row = 0;
};

/// Whether an event of this kind comes where e goes from one sign to another.
bool fires(model::Dynamics::EventKind kind, int from, int to);
/// Whether it comes where e goes from 0 to a sign.
bool leaves_zero(model::Dynamics::EventKind kind, int to);
/// The sign of e, 0 where rounding hides it.
int side_of(Text& crossing, const Eigen::VectorXd& x, const Eigen::VectorXd& rounding);

class FlowInside {
 public:
  /// All must outlive it.
  FlowInside(Texts& texts, std::vector<EventMemory>& memory, Faults& faults)
      : texts_(texts), memory_(memory), faults_(faults) {}

  /// Checks one piece. Sides and marks of the events are those at its end afterwards.
  void operator()(std::size_t part, const hybrid::FlowPiece& piece);

 private:
  /// A point of a flow.
  struct Sample {
    double t = 0;
    Eigen::VectorXd x;
    Eigen::VectorXd sizes;  ///< of its step
  };

  /// Rising, each once.
  static std::vector<double> sample_times(const hybrid::FlowPiece& piece);
  /// Points at sample_times, with the sizes of their steps.
  std::vector<Sample> samples(const hybrid::FlowPiece& piece) const;
  /// The point at t: what rests has the bits that it has at the start of the piece.
  Sample sample(const hybrid::FlowPiece& piece, double t) const;
  /// What is true at a point up to so many times its rounding.
  Truth truth(Guard& guard, const Sample& at, double times = 1);
  /// A fault where the condition is surely true inside. Without an event it is that of a flow set,
  /// `left`.
  void watch_condition(const hybrid::FlowPiece& piece, const std::vector<Sample>& all, Guard& guard,
                       std::optional<std::size_t> event, const std::string& what);
  /// A fault where e surely goes to the side on which the event fires.
  void watch_crossing(const hybrid::FlowPiece& piece, const std::vector<Sample>& all,
                      std::size_t event);
  /// A fault where a clock runs down inside; an occurrence that `if` rejects is spent.
  void watch_clock(const hybrid::FlowPiece& piece, std::size_t event);
  /// Whether an occurrence at a point must jump: its `if` is true, for sure.
  bool must_jump(std::size_t event, const Sample& at);
  /// Where `value` is largest between two points on both sides of a point where it is larger; an
  /// early stop where it is > 0.
  static double highest(double low, double high, const std::function<double(double)>& value);
  /// The first point, up to rounding, of (low, high] where `is_there` is.
  static double entry(double low, double high, const std::function<bool(double)>& is_there);

  Texts& texts_;
  std::vector<EventMemory>& memory_;
  Faults& faults_;
  std::size_t part_ = 0;
};

}  // namespace gainsmith::judge
