// Dynamics with one clock and nothing else that makes a jump: what campaigns run with error bounds.
//
//   flow, while the timer tau runs down to 0:   x' = f(x, tau),  tau' = -1
//   jump, when tau = 0:                          x+ = g(x),       tau+ a length of the clock
//
// x stacks the states, in the order of the dynamics; tau is what is left of the clock. Whether the
// flow is M x + b with constant M and b is read from its program: such a flow is exact (steps.h).
// Jump maps may be any expression. Runs are those of the careful simulator (simulate/simulator.h):
// the same draws, the same maps.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "bounded/tolerances.h"
#include "bounded/track.h"
#include "hybrid/affine.h"
#include "hybrid/scenario.h"
#include "hybrid/state_layout.h"
#include "hybrid/system.h"

namespace gainsmith::bounded {

/// One state's derivative, or its value after a jump, as a function of the whole state.
struct MapEntry {
  std::size_t slot = 0;
  expr::Program program;
};

struct SampledSystem {
  const hybrid::System* dynamics = nullptr;
  hybrid::StateLayout layout;         ///< the states, and the name of the timer
  std::vector<std::size_t> variable;  ///< of the dynamics, of each slot
  std::vector<MapEntry> flow_entries;
  std::optional<hybrid::AffineMap> flow;  ///< when it is affine and does not depend on the timer
  Place flow_place;                       ///< of the fastest part of the flow
  std::vector<MapEntry> jump;             ///< states that change; the others keep their value
  std::optional<hybrid::AffineMap> affine_jump;  ///< when every entry of `jump` is affine
  double longest = 0;                            ///< length between jumps, or up to the first one

  const numbers::Values& constants() const { return dynamics->constants; }
};

/// Whether what a program computes from the states has a bound of its error (ball.h): projections,
/// eigenvalues, solutions of Riccati equations and of flows, extrema, pseudo-inverses, bases and
/// determinants have none.
bool has_error_bound(const expr::Program& program, const hybrid::StateLayout& layout);

/// The same dynamics in this form; none when they are of another kind. Of another kind are other
/// events, conditions, noise, measured data, modes, losses, and texts that ask for the time, branch
/// or have no error bound. The dynamics must outlive it.
std::unique_ptr<const SampledSystem> make_sampled_system(const hybrid::System& dynamics);

/// The draws of one run: its first state, and the lengths from jump to jump.
class SampledDraws {
 public:
  SampledDraws(const SampledSystem& system, const hybrid::Scenario& scenario, std::uint64_t seed,
               std::uint64_t run);

  const Eigen::VectorXd& start() const { return start_; }
  /// Up to the next jump.
  double length() const { return clocks_.length(0); }
  /// The time of the next jump.
  double due() const { return clocks_.due(0); }
  /// Whether the next jump belongs to a run up to the horizon.
  bool is_within(double horizon) const { return clocks_.is_due(0, horizon); }
  void jumped() { clocks_.advance(0, clocks_.due(0)); }

 private:
  Eigen::VectorXd start_;
  hybrid::EventClocks clocks_;
};

/// From the start of a track to the horizon, to its end before, or to the most jumps. `flow` takes
/// the length of a flow, `jump` that of the next one; both append to the track. Whether the run
/// ended with a jump.
template <class Scalar, class Flow, class Jump>
bool flow_and_jump(SampledDraws& draws, double horizon, Track<Scalar>& track, Flow flow,
                   Jump jump) {
  const auto has_ended = [&] { return track.termination != Termination::horizon; };
  while (true) {
    const bool jumps = draws.is_within(horizon);
    flow(jumps ? draws.length() : horizon - track.t.back());
    if (has_ended() || !jumps) return false;
    if (track.j.back() >= kMostJumps) {
      track.termination = Termination::jump_limit;
      return false;
    }
    track.t.back() = draws.due();
    draws.jumped();
    jump(draws.length());
    if (has_ended() || track.t.back() >= horizon) return true;
  }
}

}  // namespace gainsmith::bounded
