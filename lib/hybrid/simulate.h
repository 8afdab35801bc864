// Runs of a hybrid system, each a function of (seed, run) alone.
//
// The draws of a run, in this order: the initial state, state by state in the method's order, one
// draw for each element of a box, column by column; the timer's first value, one draw unless the
// campaign gives it; then one draw at each jump of a law that draws (uniform, extremes). Run i uses
// law i modulo their number.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "hybrid/arc.h"
#include "hybrid/initial.h"
#include "hybrid/law.h"
#include "hybrid/steps.h"
#include "hybrid/system.h"

namespace gainsmith::hybrid {

/// A run of which a state leaves [-this, this] has diverged.
constexpr double kLargestState = 1e150;

/// What the runs of a campaign have in common.
struct Scenario {
  std::vector<Law> laws;
  std::vector<StartRule> starts;
  std::optional<double> first;  ///< first value of the timer; none: uniform in its range
  double horizon = 0;
  std::int64_t jump_limit = 1000000;
};

/// InputError for laws and initial values that do not fit the system, a first timer value outside
/// its range and a horizon that is not positive. Without a horizon: 40 of the
/// longest intervals, so that it has the units of the timer.
Scenario make_scenario(const model::Design& design, const System& system);

/// Whether a timer that has this value at t runs down before the horizon or, to the rounding of
/// many intervals added up, at it.
bool expires(double timer, double t, double horizon);

/// The timer's first value: one draw unless the campaign gives it.
double first_timer(const System& system, const Scenario& scenario, RandomStream& random);

/// Simulates run after run; one for each thread. System, scenario and steps must outlive it.
class Simulator {
 public:
  Simulator(const System& system, const Scenario& scenario, const FlowSteps& steps);

  /// The solution on [0, horizon]. The timer is stepped to, not searched for: the flow before a
  /// jump has exactly the length of the timer's value, the time at the jump is the time at the last
  /// reset plus it, and each expiry jumps once. A jump at the horizon belongs to the run; a first
  /// value of 0 is a jump at t = 0.
  Arc run(std::uint64_t seed, std::uint64_t run);

 private:
  void flow(double interval, Arc& arc);
  void jump(Arc& arc, double reset_value);

  const System* system_;
  const Scenario* scenario_;
  const FlowSteps* steps_;
  Starts starts_;
  std::vector<PointFunction> jump_entries_;  ///< when the jump map is not affine
  std::vector<FlowStep> cuts_;
};

/// The steps that every run of the scenario can be cut into. The flow must be affine.
FlowSteps make_steps(const System& system);

}  // namespace gainsmith::hybrid
