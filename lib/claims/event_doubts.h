// Events within their errors: where it is not certain which of them happen, in which order, or what
// their jumps do.
//
//   turn    a guard whose turning point lies nearer to 0 than its error there
//   order   an event whose guard lies within its error when another one happens, so that it may
//           come before or after, and whose maps do not commute on that state
//   step    what a map branches on (expr/program/branches.h), by a jump of its value, lies within
//           its error: a number that is rounded, next to a tie
//   zero    a jump leads what an event is a crossing of to 0, up to its error: leaving 0 is a
//           crossing
//
// The error of a guard has three parts: that of the difference of the two runs, what its terms
// round, and its rate times the error of the time of the other event. Clocks strike when they do:
// two of them are in the order of the file, as are guards that are 0 together bit by bit.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "claims/independence.h"
#include "claims/twin_parts.h"
#include "simulate/event_watch.h"
#include "simulate/jump_maps.h"

namespace gainsmith::claims {

class EventDoubts {
 public:
  /// The system must outlive it.
  explicit EventDoubts(const hybrid::System& system);

  struct Doubt {
    std::size_t part = 0;  ///< of TwinParts
    double t = 0;
    std::string why;
  };
  /// The first of all doubts about a run with its turning points.
  std::optional<Doubt> first(const hybrid::Trajectory& run, const TwinParts& twins);

  /// Why a turning point is uncertain, in the flow in which it lies; none: it is certain.
  std::optional<std::string> of_turn(const hybrid::NearTurn& turn, const TwinFlow& flow);
  /// The parts whose jumps of_jump is asked about, best in their order. They must outlive it.
  void begin(const TwinParts& twins);
  /// Why what a jump does, or its order and that of another event, is uncertain.
  std::optional<std::string> of_jump(std::size_t jump);

  simulate::JumpMaps& maps() { return maps_; }

 private:
  /// A guard at a jump and shortly before.
  struct Guard {
    hybrid::EventFunction* function = nullptr;
    std::size_t comparison = 0;
    double value = 0, before = 0;
    double error = 0;  ///< without that of the time
  };
  /// What is known at a jump.
  struct Instant {
    Eigen::VectorXd now, twin, before;
    double t = 0, since = 0;  ///< the time, and how long ago `before` was
    double time_error = 0;    ///< of the event that happens
    std::size_t event = 0;
    bool lost = false;
    std::vector<Guard> own;  ///< of that event
  };

  /// Whether a part is a flow that is longer than an instant.
  bool is_long(std::size_t part) const;
  void walk_to(std::size_t jump);
  std::optional<Instant> instant(std::size_t jump);
  std::vector<Guard> guards(std::size_t event, const Instant& at);
  void set_time_error(Instant& at);
  bool may_happen(std::size_t event, const Instant& at, const std::vector<Guard>& guards);
  bool stays(const Instant& at, const Eigen::VectorXd& values);
  bool is_on_step(const Instant& at);
  bool leads_to_zero(hybrid::EventFunction& crossing, std::size_t jump);
  /// Whether a crossing was never farther from 0 than its rounding, on the flow just
  /// before.
  bool stays_at_zero(hybrid::EventFunction& crossing, std::size_t jump);
  bool leads_exactly_to_zero(hybrid::EventFunction& guard, Eigen::Index e, const TwinJump& own);
  /// Whether a jump leads values to where the condition is another one within their error.
  bool leads_to_a_tie(hybrid::EventCondition& condition, std::size_t jump);
  bool becomes_due(std::size_t event, std::size_t jump);
  /// What of an event a jump leads to where its error decides, in words; empty: nothing.
  std::string tie(std::size_t event, std::size_t jump);
  std::optional<std::string> clocks_after(std::size_t jump, const Instant& at);
  bool fires(std::size_t event, const std::vector<Guard>& guards, const Instant& at,
             const Eigen::VectorXd& values);
  bool commute(std::size_t other, const std::vector<Guard>& guards, const Instant& at);
  std::string message(const Instant& at, std::size_t other, double distance, double error) const;
  Eigen::VectorXd whole(const Eigen::VectorXd& variables) const;

  const hybrid::System* system_;
  simulate::EventWatch watch_;
  simulate::JumpMaps maps_;
  Independence are_independent_;
  std::vector<std::vector<hybrid::Breaks>> breaks_;  ///< by event: of its maps that branch
  bool has_clocks_ = false;
  const TwinParts* twins_ = nullptr;
  std::vector<std::size_t> next_clock_;      ///< by part: the next jump of a clock in its instant
  std::size_t next_ = 0;                     ///< up to this part:
  const hybrid::FlowPiece* flow_ = nullptr;  ///< the last flow that is longer than an instant
  std::optional<std::size_t> first_;         ///< the first event since then
  std::vector<bool> happened_;               ///< by event: whether it has since then
};

}  // namespace gainsmith::claims
