// The worst run, sought and not sampled: over starts, lengths of flows, losses, noise and uncertain
// data, within what the dynamics and the campaign allow.
//
// The margin of a claim in a run is how far its value is beyond its bound: on a logarithmic scale
// where both are positive, so that it has no units and rises evenly from a held claim to a violated
// one. It is maximised without derivatives, for each claim
//
//   1. over runs whose lists of draws repeat after one, two and three draws (draw_cube.h), and after
//      the period in which linear errors grow fastest (periodic_lengths.h): all over the cube by
//      NLopt's CRS2, then near the best point by a simplex and BOBYQA
//   2. from the best of these, if it does not violate, over all draws one by one, each at both ends
//
// The search goes by one computation of each run. The worst is judged as a run of a campaign
// (judge.h), and what is reported as violated violates when it is repeated too. That none was found
// shows nothing.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hybrid/given_run.h"
#include "model/words.h"
#include "verify/periodic_lengths.h"

namespace gainsmith::verify {

struct WorstOptions {
  std::uint64_t seed = 1;  ///< of the search
  /// At most, or a little more to share them evenly; none: 3000 of a linear sampled
  /// plant, otherwise 600.
  std::optional<std::uint64_t> runs;
  unsigned threads = 0;  ///< 0: one a core; the report does not depend on it
};

struct WorstReport {
  model::CampaignVerdict verdict = model::CampaignVerdict::undecided;
  std::uint64_t runs = 0;  ///< that were made
  std::uint64_t seed = 0;
  double horizon = 0;
  bool interrupted = false;  ///< then the findings are those of one computation of each run
  /// Of the claims that are stated, each in the worst run that was found for it: run k of `given` for
  /// element k; none when no run was made.
  std::vector<claims::NamedFinding> claims;
  /// Claims that are not stated, with what has no value.
  std::vector<std::pair<std::string, std::vector<std::string>>> missing;
  std::vector<hybrid::GivenRun> given;
  std::optional<PeriodicLengths> lengths;  ///< in which linear errors grow fastest
};

/// Deterministic. A stop (base/stop.h) leaves the report with what was found so far, undecided.
/// InputError when nothing is drawn, no claim is stated, or NLopt is not there.
WorstReport search_worst(const model::Instance& instance, const model::Gains& gains,
                         const WorstOptions& options);

/// The margin of a finding; the larger the worse. Beyond +-1e6 where there is no number.
double margin_of(const claims::Finding& finding, model::ClaimKind kind);

}  // namespace gainsmith::verify
