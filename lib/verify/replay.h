// One run of dynamics with events, with everything that a person wants to see of it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "claims/claim_check.h"
#include "judge/judge.h"
#include "verify/setup.h"

namespace gainsmith::verify {

/// Where a claim is made, and what its value must not exceed or fall below.
struct ClaimScope {
  double after = 0;              ///< the time from which on
  std::string over;              ///< the event just after whose jumps alone; empty: everywhere
  std::optional<double> bound;   ///< of `below` and `above`
  std::optional<double> factor;  ///< of `shrinks`: the bound is that times the first value
};

/// A quantity along a run: an element of a variable or of a signal, or the value of a claim.
struct Column {
  std::string name;  ///< as it is shown, "xh1"; of several observers with the name, "nominal.xh1"
  std::string stem;  ///< without observer and element: "xh"
  std::string observer;  ///< empty: of the plant, of all
  enum class Kind { time, jumps, state, mode, other, signal, claim } kind = Kind::other;
  ClaimScope scope{};  ///< of a claim
  int element = 0;     ///< of a matrix, column by column
};

/// Rows: the start, points of each flow and its end, the values after each jump.
struct Replay {
  hybrid::Trajectory run;
  std::vector<Column> columns;
  numbers::Matrix table;  ///< not a number where there is none
  /// Of each cell how far it moves when all variables move by up to kShownPlaces (tolerances.h),
  /// in either direction, whichever is less: a value that is not larger is made of rounding. 0 of
  /// variables. Empty unless it was asked for.
  numbers::Matrix rounding;
  std::vector<std::string> events;  ///< of each row: the jump that it comes after, or empty
  std::vector<claims::NamedFinding> claims;  ///< exactly what the campaign found in this run
  std::vector<judge::Fault> faults;          ///< that the judge of runs found
};

/// A run of a campaign by itself, to kAccuracyOfOne (tolerances.h). After a stop (base/stop.h) as far
/// as it came.
hybrid::Trajectory run_of(const Setup& setup, std::uint64_t seed, std::uint64_t run);

/// The run and its table alone. `step`: of the points of flows; 0: as the integration went.
/// `with_rounding`: what is rounding in each value, for pictures. After a stop (base/stop.h) the run
/// as far as it came. InputError for a step that makes more than 1e7 points.
Replay table_of_run(const Setup& setup, std::uint64_t seed, std::uint64_t run, double step,
                    bool with_rounding = false);

/// The table of a run that is there, without claims and faults.
Replay table_of_run(const Setup& setup, hybrid::Trajectory run, double step,
                    bool with_rounding = false);
/// Adds what is rounding to a table of that step.
void add_rounding(const Setup& setup, double step, Replay& replay);

/// The same with the claims, which a stop leaves out. `judged`: whether the run is checked against
/// the texts.
Replay replay_run(const Setup& setup, std::uint64_t seed, std::uint64_t run, double step,
                  bool judged = false);

}  // namespace gainsmith::verify
