// What the runs of a System have in common besides it, and what is drawn in them.
//
// Every draw is a pure function of (seed, run, what it is for, its number), so that the draws of
// one event do not depend on how often another one happened:
//
//   key    = Philox4x32-10 of the counter (purpose, index, 0, 0) with the seed as key, its first 64
//            bits
//   stream = RandomStream(key, run)
//
//   purpose  index     draws
//   start    variable  one for each element of a box, column by column; of a symmetric state of its
//                      lower triangle; around a center those of initial.h
//   first    event     one: the first time within the range of `first`
//   length   event     one a length, of the laws that draw
//   lost     event     draw k at occurrence k = 0, 1, ...
//   noise    noise     those of initial.h of normal and lognormal noise; one an element and drawing
//                      of uniform noise; none of vertices and corners, where run k takes one by its
//                      number
//   places   moved run signs of moves in the last places (simulate/last_places.h)
//
// Philox4x32-10 is the counter-based generator of Salmon, Moraes, Dror & Shaw 2011: a run can be
// repeated alone, in any order and on any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "base/random.h"
#include "hybrid/given_run.h"
#include "hybrid/initial.h"
#include "hybrid/law.h"
#include "hybrid/system.h"

namespace gainsmith::hybrid {

struct Scenario {
  double horizon = 0;
  /// By variable; of states and modes. None: they start where the dynamics say.
  std::vector<std::optional<StartRule>> starts;
  /// By event; run i uses law i modulo their number. Without one: uniform.
  std::vector<std::vector<Law>> laws;
  std::vector<std::optional<double>> first;  ///< by event: the first time, in place of a draw
  /// Variables b that hold a difference a - b, with a: drawn as b, then taken from a.
  std::vector<std::pair<std::size_t, std::size_t>> differences;
  /// Run i takes element i modulo their number in place of draws. Must outlive the scenario.
  const std::vector<GivenRun>* given = nullptr;

  /// Of a run; nullptr: all is drawn.
  const GivenRun* given_for(std::uint64_t run) const {
    return given == nullptr || given->empty() ? nullptr : &(*given)[run % given->size()];
  }
};

/// Whether a state starts in the box [-1, 1] where nothing says so: beside a timer, unless it is
/// symmetric or a mode.
bool starts_in_a_box(const model::Dynamics& dynamics, const model::Dynamics::Variable& state);

/// Laws and horizon of a campaign; `starts` of the campaign name variables of the dynamics. Every
/// event with a range of lengths has the campaign's laws, by default those of law.h. InputError for
/// laws and starts that do not fit, a state that starts nowhere, and a horizon that is not
/// positive.
Scenario make_scenario(const model::Design::Campaign& campaign, const System& system);

/// Where the dynamics say that states start, up to a horizon.
Scenario make_scenario(double horizon, const System& system);

/// What a stream of draws is for: the first column of the table above. Its numbers are part of the
/// draws, so that a change of them changes all runs.
enum class Purpose : std::uint32_t { start = 1, first, length, lost, noise, last_places };

/// The key of a stream, which all runs of a seed share.
std::uint64_t stream_key(std::uint64_t seed, Purpose purpose, std::size_t index);
RandomStream draw_stream(std::uint64_t seed, std::uint64_t run, Purpose purpose, std::size_t index);

/// The values of all variables at the start of a run, branches 0. InputError where a text has no
/// value, a mode is no whole number, or a symmetric state does not start so.
Eigen::VectorXd draw_start(const System& system, const Scenario& scenario, std::uint64_t seed,
                           std::uint64_t run);

/// Whether a time has come at t: times that differ by rounding alone are one instant.
constexpr bool has_come(double time, double t) {
  return time <= t + kOneInstant * (t < 0 ? -t : t);
}

/// When the events with a clock are due in one run.
class EventClocks {
 public:
  EventClocks(const System& system, const Scenario& scenario, std::uint64_t seed,
              std::uint64_t run);

  /// The time of the next occurrence; infinity for events without a clock or with none left.
  double due(std::size_t event) const { return clocks_[event].due; }
  /// The length drawn for it: the time from the one before, or from the start.
  double length(std::size_t event) const { return clocks_[event].length; }
  /// The earliest of all.
  double next() const;
  bool is_due(std::size_t event, double t) const { return has_come(clocks_[event].due, t); }
  /// The occurrence at t is over.
  void advance(std::size_t event, double t);
  /// Whether no observer sees occurrence k = 0, 1, ... of the event; asked for each once, in order.
  bool loses(std::size_t event);

 private:
  struct Clock {
    double due = 0;
    double length = 0;
    std::uint64_t occurrences = 0;  ///< so far
    std::uint64_t lengths = 0;      ///< drawn so far
    double first = 0;
    RandomStream random;
    RandomStream lost;
    std::uint64_t jumps = 0;
    int lost_in_a_row = 0;
  };
  double first_due(std::size_t event, Clock& clock, std::uint64_t seed) const;
  double drawn_length(std::size_t event, Clock& clock, double t) const;

  const System* system_;
  const Scenario* scenario_;
  std::uint64_t run_;
  std::vector<Clock> clocks_;
};

/// The noise of one run.
class NoiseDraws {
 public:
  NoiseDraws(const System& system, const Scenario& scenario, std::uint64_t seed, std::uint64_t run);

  /// The next value of a noise, written to its variables.
  void draw(std::size_t noise, Eigen::VectorXd& values);
  /// When a noise with a time of its own is drawn next; infinity when none is.
  double next() const;
  /// Draws all that are due at t; whether there were any.
  bool draw_due(double t, Eigen::VectorXd& values);

 private:
  Eigen::VectorXd next_value(std::size_t noise);

  const System* system_;
  const GivenRun* given_;
  std::uint64_t run_;
  std::vector<RandomStream> random_;
  std::vector<std::uint64_t> number_;  ///< of the next value, of those that are given
  std::vector<std::uint64_t> times_;   ///< drawn by time so far
};

}  // namespace gainsmith::hybrid
