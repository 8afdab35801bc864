// What some runs of a campaign have in common: counts, and the worst of them.
//
// Tallies of different runs are added in any order and grouping to the same bits: of threads, of
// parts of a campaign, of one that was stopped and went on. Of runs that are equally bad the one
// with the lowest number is the worst.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "claims/claim_check.h"
#include "claims/track.h"
#include "packs/pack_runner.h"
#include "verify/judge.h"

namespace gainsmith::verify {

/// Why a run is undecided.
struct UndecidedRun {
  std::uint64_t run = 0;
  claims::Termination termination = claims::Termination::horizon;
  std::string message;      ///< why it ended before the horizon
  std::size_t check = 0;    ///< of a run that reached it: the claim ...
  claims::Finding finding;  ///< ... and what is known of it

  bool operator==(const UndecidedRun&) const = default;
};

/// Its claim is counted among those that are stated.
UndecidedRun undecided_run(std::uint64_t run, claims::Termination termination,
                           const std::string& message,
                           const std::vector<claims::Finding>& findings);

/// One claim over some runs. In order of precedence the worst run violates it, or is undecided;
/// then it has the largest score.
struct ClaimTally {
  std::uint64_t violations = 0;
  std::uint64_t undecided = 0;
  std::uint64_t run = 0;  ///< the worst
  claims::Finding worst;
  double floor = 0;

  bool operator==(const ClaimTally&) const = default;
};

/// The worst of some runs. In order of precedence it violates; it does not reach the horizon; it is
/// undecided; the largest score of a claim, of those that it violates if any.
struct WorstRun {
  std::uint64_t run = 0;
  claims::Judgement judgement = claims::Judgement::held;
  double score = 0;
  claims::Termination termination = claims::Termination::horizon;

  bool operator==(const WorstRun&) const = default;
};

/// A run that does not reach the horizon.
struct UnfinishedRun {
  std::uint64_t run = 0;
  claims::Termination termination = claims::Termination::horizon;
  std::string message;

  bool operator==(const UnfinishedRun&) const = default;
};

/// Counts are those of runs; `worst` and the first ones are of all runs added.
struct Tally {
  std::uint64_t runs = 0;  ///< 0: all that follows is empty
  std::uint64_t violations = 0;
  std::uint64_t undecided = 0;
  std::uint64_t unfinished = 0;
  std::uint64_t repeated = 0;
  std::uint64_t careful = 0;  ///< made one by one
  std::array<std::uint64_t, packs::kWhys> open{};
  std::vector<std::uint64_t> confirmed;  ///< runs that violate again when repeated, in order
  std::optional<WorstRun> worst;
  std::optional<UnfinishedRun> first_unfinished;
  std::optional<UndecidedRun> first_undecided;
  std::vector<ClaimTally> claims;  ///< that are stated, in order
  std::vector<char> happened;      ///< by event: whether it did in any of them

  bool operator==(const Tally&) const = default;
};

/// Of one run.
Tally tally_of(std::uint64_t run, const RunVerdict& verdict);

/// Adds other runs.
void add(const Tally& more, Tally& sum);

}  // namespace gainsmith::verify
