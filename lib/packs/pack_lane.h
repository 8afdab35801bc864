// One lane of a pack: where its run is.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "hybrid/zeno.h"
#include "packs/claim_lane.h"
#include "packs/moves.h"
#include "packs/pack_watch.h"

namespace gainsmith::packs {

enum class Phase : std::uint8_t {
  evaluate,  ///< at an instant, its values have changed: what follows is to be found out
  step,      ///< flows
  jump       ///< an event is due
};

/// The state of one run in its lane, but for its values, which are in LaneSet. Times are in units
/// of the time of the system. Vectors by watch, event or claim have the order of the PackSystem.
struct PackLane {
  PackLane(const PackSystem& pack, std::uint64_t seed, std::uint64_t run)
      : run_number(run),
        moves(run),
        clocks(*pack.system, *pack.scenario, seed, run),
        noise(*pack.system, *pack.scenario, seed, run),
        sides(pack.watches.size(), 0),
        before(pack.watches.size(), 0),
        zero(pack.watches.size(), 0),
        passed(pack.watches.size(), 0),
        relevant(pack.watches.size(), 0),
        signs(pack.events.size(), 0),
        crossed(pack.events.size(), 0),
        spent(pack.events.size(), 0),
        happened(pack.events.size(), 0),
        claims(pack.claims.size()),
        zeno(*pack.system, pack.scenario->horizon),
        largest(Eigen::VectorXd::Zero(pack.system->size)) {}

  std::uint64_t run_number = 0;
  Moves moves;
  Phase phase = Phase::evaluate;
  bool fresh = true;  ///< at the start, of which no claim knows yet
  double t = 0;
  double stop = 0;  ///< to which the flow is stepped
  double flow_start = 0;
  double h = 0;       ///< of this step
  double wanted = 0;  ///< the step that the control of errors wants
  double forced = 0;  ///< a shorter one, to a root or to see more; 0: none
  int halvings = 0;
  int target = -1;  ///< the watch whose root a step goes to
  int retakes = 0;
  int steps = 0;            ///< in this flow
  int evaluations = 0;      ///< at this instant
  bool has_jumped = false;  ///< at this instant
  hybrid::EventClocks clocks;
  hybrid::NoiseDraws noise;
  Sides sides;
  std::vector<double> before;  ///< by watch: its value before the last change
  std::vector<double> zero;  ///< by watch: within which it is 0 where a flow has ended at its root
  std::vector<char> passed;  ///< by watch: it has changed its side on this step
  std::vector<char> relevant;      ///< by watch, in this flow
  bool undetermined = false;       ///< a condition hangs on a side that the next step tells
  std::vector<std::int8_t> signs;  ///< by event with a crossing: the last sign that was not 0
  std::vector<char> crossed, spent, happened;  ///< by event
  std::optional<std::size_t> due;              ///< the event that jumps
  std::optional<std::size_t> jumped;           ///< that has jumped, of which no claim knows yet
  bool moved = false;  ///< both runs along their flows to their roots, by these times
  double coarse_shift = 0, fine_shift = 0;
  std::vector<ClaimLane> claims;
  std::vector<ClaimLane> claims_before;  ///< this step, to come back to
  hybrid::ZenoDetector zeno;
  Eigen::VectorXd largest;  ///< of all values, in this flow
};

}  // namespace gainsmith::packs
