// The event-driven simulator: runs of a System, each a function of (seed, run) alone.
//
//   At an instant the events are asked in their order: the first that is due jumps, alone, and all
//   are asked again. When none is due the flow goes on, to the first time at which one is. Clocks
//   and event functions that are affine in time are stepped to; the zero crossings of all others
//   are searched along the dense output (crossings_on_step.h). After each root in order all events
//   are asked. The start is an instant like any other, and so is the horizon.
//
//   when      due while its condition is true
//   rises, falls, crosses
//             due once when the sign of e has changed in that direction, by flow or by a jump of
//             another event; the last sign counts that was not 0. Where the start or a jump led e
//             to 0, but for rounding, it changes its sign when it leaves 0. A root is met once: within
//             its rounding e does not come back, whatever else happens at it
//   every, at due at their times; times of several clocks that differ by rounding alone are one
//             instant
//
// Noise of an event is drawn anew when it is due, before `if` and the maps; all noise is drawn once
// at the start. An occurrence that `if` rejects is spent: the clock goes on, a crossing is over,
// and `when` is due again once its condition has been false. `lost` is asked for each jump.
//
// Between zero crossings `where`, `sign`, `abs`, `max` and `min` in a flow keep their branch
// (hybrid/switches.h, branches.h); where one changes the flow starts again with the new branch.
//
// A solution is a hybrid arc (Goebel, Sanfelice & Teel 2012). One round of a run, with x = values:
//
//   instant()   while an event is due: x = g(x), j + 1
//   flow()      stop = the earliest clock, noise, row of data, line or horizon
//               while t < stop and nothing happens: one step with dense output; its first event,
//               change of a branch or end of a flow set cuts it off there
//
//   due_events, event_watch, crossings_on_step    which event is due, and zero crossings
//   flow, exact_flow, integrated_flow, flow_31    the steps of flows
//   vector_field, step_values   x' and the values on a step
//   branches, sliding           switches of the flow
//   flow_sets, jump_maps, measured_rows, last_places, state_31, run_record    the rest
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "hybrid/scenario.h"
#include "hybrid/system.h"
#include "hybrid/trajectory.h"
#include "simulate/flow.h"
#include "simulate/run_record.h"

namespace gainsmith::simulate {

/// Simulates run after run; one for each thread. System and scenario must outlive it.
class Simulator {
 public:
  /// A stop (base/stop.h) ends the run as interrupted, at its next step or jump.
  Simulator(const hybrid::System& system, const hybrid::Scenario& scenario);
  Simulator(Simulator&&) noexcept;
  Simulator& operator=(Simulator&&) noexcept;
  ~Simulator();

  /// The solution on [0, horizon], or to where it ends before, with the reason. InputError for what
  /// is wrong in the text whatever the run: a symmetric state that jumps or flows out of symmetry,
  /// a mode that is no whole number.
  /// Accuracy::in_31_digits: of systems that may run so (state_31.h) alone; a run that cannot be
  /// followed so is lost.
  /// `moved`: the number of a perturbed run, moved in the last places (last_places.h). None: the
  /// run itself.
  hybrid::Trajectory run(std::uint64_t seed, std::uint64_t run, const Accuracy& accuracy = {},
                         const RecordLimits& limits = {}, std::optional<std::uint64_t> moved = {});

 private:
  struct Texts;
  const hybrid::System* system_;
  const hybrid::Scenario* scenario_;
  std::unique_ptr<Texts> texts_;
};

}  // namespace gainsmith::simulate
