// What the packs of a campaign run: a System and its claims as code over lanes, made once. A pack
// is kLanes = 32 runs of one campaign that are computed side by side, a lane each.
//
//   step    values, h, the factors of a PackAccuracy -> the values that move after a step of length
//           h by the method of order 8 of Dormand and Prince, and its error as a part of what is
//           allowed
//   point   values -> rates, claims with their rates, and what is watched: the differences of
//           conditions, of crossings and of switches, with their rates
//   jump    of each event: values -> values after its maps
//
// The cost of a claim so far is one more value that flows and jumps.
//
// A pack decides a run where its estimates of errors suffice, and leaves it open otherwise. They
// come from two runs over the same steps (pack_runner.h), and are no bounds.
//
// What packs do not run: loops of jumps, measured data, claims and conditions that have no formula
// for their rates. Such campaigns are left to the careful run.
//
//   pack_graph.h    texts as nodes of a scalar graph       jump_code.h    the maps of events
//   pack_runner.h   runs of any System, by steps           lane_set.h     its lanes
//   quintics.h      values between the points of a step    claim_lane.h   one claim along one run
//   linear_runner.h runs of a linear sampled system        sharp_parts.h  what quintics may miss
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "claims/claims.h"
#include "claims/tolerances.h"
#include "hybrid/scenario.h"
#include "hybrid/system.h"
#include "lanes/machine.h"
#include "packs/pack_graph.h"

namespace gainsmith::packs {

/// Of the coarser of both runs: times the accuracy of the careful run.
struct PackAccuracy {
  double relative = 1;
  double absolute = 1;
};

/// A difference whose sign matters, to conditions, crossings and branches of the flow.
struct Watch {
  /// An element of the values that holds a branch of the flow.
  struct Branch {
    std::size_t element = 0;
    int factor = 1;      ///< the branch is of this times the difference
    bool sign = false;   ///< it is sign(D), otherwise that of `where`
    bool strict = true;  ///< of `where`: D > 0, otherwise D >= 0
  };
  /// Whether it changes along flows. What does not is known without an error at every point.
  bool moves = true;                  ///< otherwise it is the same along a flow, and exact
  const expr::Program* of = nullptr;  ///< of which it is an element
  std::size_t element_of = 0;
  std::vector<Branch> branches;
};

/// A watch, or what is opposite to it.
struct Watched {
  std::size_t watch = 0;
  int factor = 1;  ///< -1: opposite
};

/// A condition over watches.
struct WatchedCondition {
  expr::Condition::Kind kind = expr::Condition::Kind::all;
  std::vector<Watched> elements;  ///< of a comparison
  std::vector<WatchedCondition> parts;
};

/// An event of the system, in its order. `when` and `crossing` exclude each other; an event with
/// neither has a clock. `only_if` decides at the instant whether its maps are applied.
struct PackEvent {
  std::optional<WatchedCondition> when, only_if;
  std::optional<Watched> crossing;
  std::optional<lanes::LaneCode> jump, lost;  ///< lost: of the plant alone
};

/// A claim that is stated, in the order of the claims. Indices of extras are those of the result
/// PackSystem::extras of `point`.
struct PackClaim {
  model::ClaimKind kind = model::ClaimKind::nonincreasing;
  /// The claim is made from this time on, in units of the time of the system.
  double after = 0;
  /// The event after whose jumps alone it is made; none: along whole runs.
  std::optional<std::size_t> over;
  double tolerance = 0;
  bool always = false;                ///< it holds wherever the states are
  bool starts_exact = false;          ///< no operation on the values at the start rounds
  bool rests = false;                 ///< along flows: jumps alone change it
  bool squared = false;               ///< the value is the square of the claim's, a norm
  std::vector<std::size_t> branches;  ///< extras: what its value branches on
  std::vector<std::size_t> kinks;     ///< those of them where it is continuous
  std::vector<std::size_t> roots;     ///< extras: of what it has square roots, norms among them
};

/// All that the lanes of one campaign share. It is read by all threads and changed by none.
/// `system` and `scenario` are owned by the caller.
struct PackSystem {
  const hybrid::System* system = nullptr;
  const hybrid::Scenario* scenario = nullptr;
  double accuracy = 0;  ///< relative, of the careful run
  /// Times the difference of both runs: the error of a value (claims/twin_parts.h).
  double error_factor = claims::kErrorOfDifference;
  std::size_t whole = 0;  ///< values
  std::vector<int> rows;  ///< that move
  std::vector<PackEvent> events;
  std::vector<WatchedCondition> flow_sets;
  std::vector<Watch> watches;
  std::vector<PackClaim> claims;
  std::vector<RunningCost> costs;
  std::vector<std::size_t> flats;  ///< extras that must not change much on a step
  std::vector<std::size_t> kinks;  ///< extras at whose zeros the flow has a kink (abs, clip, max)
  std::optional<lanes::LaneCode> step, start;
  /// At the points of steps; at the end of the coarser run, values with the rates of watches alone;
  /// and between the points, values and extras alone.
  std::optional<lanes::LaneCode> point, coarse_point, between_points;
  /// Of claims, then of watches, over a step (quintics.h).
  std::optional<lanes::LaneCode> polynomials;

  /// Results of `step`.
  enum StepResult : std::size_t { end, error };
  /// Results of `start`, of each claim: the bound or the factor, of a cost its value at the start;
  /// of a cost also the sum of the absolute values of its terms.
  enum StartResult : std::size_t { limits, limit_terms };
  /// Results of `point`. terms: the sums of the absolute values of the terms of a value; extras:
  /// the differences that claims branch on.
  enum PointResult : std::size_t {
    rates,
    claim_values,
    claim_rates,
    claim_terms,
    watch_values,
    watch_rates,
    watch_terms,
    extras
  };
};

/// `relative`, `absolute`: to which the careful run of a campaign integrates, the latter of each
/// element. nullptr for what packs do not run. The system, the scenario and the
/// claims must outlive it.
std::unique_ptr<const PackSystem> make_pack_system(const hybrid::System& system,
                                                   const hybrid::Scenario& scenario,
                                                   const std::vector<claims::Claim>& claims,
                                                   double relative,
                                                   const Eigen::VectorXd& absolute);

}  // namespace gainsmith::packs
