// The judge of event-driven runs: whether a Trajectory satisfies the texts of its Dynamics.
//
// It shares nothing with what simulates but the evaluator. Rules: model/dynamics.h. It checks
//   flows    each recorded step again by Gauss steps (ode/gauss.h) from its start, at its quarters
//            and at its end, to 100 times the accuracy of the run; the sum of the differences
//            over a flow; what rests (modes, frozen components, noise) rests; clocks run at their rates
//            Rates inside of a step are those of compiled programs where these agree with the texts
//            at both of its ends; a step that differs is judged by the texts alone.
//   jumps    recomputed from the texts: reactions, passes, counts; a component without a reaction
//            keeps its bits, and observers do where the occurrence is lost
//   events   at each instant the first that is due jumps, and a flow begins when none is; inside a
//            flow, at 16 points a step and at the extrema between them, no condition is true, no
//            event function crosses zero, no clock has run down
//   draws    clock lengths, losses, noise and starts lie in their ranges; and, where the question
//            says from which seed, they are the draws of its streams (draws.h)
//   the end  has its cause
//
// Where the recorded values alone decide (which event is due at an instant) decisions are exact;
// that an event was due, and what is true inside a flow, may hang on rounding and is a fault only
// where no rounding explains it.
//
// The files: texts (programs and conditions with their rounding), flow and step (flows again),
// jump, measured, events with inside and clocks (what is due), draws, end, faults.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hybrid/trajectory.h"
#include "model/design.h"
#include "model/dynamics.h"
#include "model/stated.h"

namespace gainsmith::judge {

/// One thing that is wrong. size <= allowed would have been right.
struct Fault {
  std::size_t part = 0;  ///< of the trajectory; the number of its parts: of its end
  double t = 0;
  std::string what;
  double size = 0;     ///< of what is wrong, where that is a number
  double allowed = 0;  ///< what it may be
};

/// Where a variable may start, besides its own `start`.
struct StartRange {
  std::size_t variable = 0;
  numbers::Matrix low, high;  ///< of its shape
};

/// Where the draws of a run come from: the streams are defined in hybrid/scenario.h.
struct DrawnFrom {
  std::uint64_t seed = 1;
  std::uint64_t run = 0;
  const model::Design::Campaign* campaign = nullptr;  ///< must outlive the judging
};

/// What the judge is told of a run besides its dynamics.
struct Question {
  double relative = 1e-10;  ///< the accuracy of the run
  double absolute = 1e-10;
  Eigen::VectorXd absolute_of;     ///< of each element of the variables; empty: `absolute` of all
  std::vector<StartRange> starts;  ///< of the variables to which a campaign gives one
  std::optional<DrawnFrom> drawn;
  /// Jumps without a flow between them that a run which is stuck shows at least.
  std::int64_t least_chain = 1000;
};

/// Of each kind of fault the worst in each part, in order of the parts. InputError for texts that
/// use what has no value.
std::vector<Fault> check_trajectory(const hybrid::Trajectory& trajectory,
                                    const model::Dynamics& dynamics, const model::Stated& stated,
                                    const Question& question = {});

}  // namespace gainsmith::judge
