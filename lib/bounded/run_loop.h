// Flows and jumps by turns: what all runs of a sampled system share.
#pragma once

#include "bounded/sampled_system.h"
#include "bounded/tolerances.h"
#include "bounded/track.h"

namespace gainsmith::bounded {

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
