// What a campaign found, as `campaign.json` keeps it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/figure_record.h"
#include "model/words.h"

namespace gainsmith::model {

/// The comparison of a claim that is nearest to a violation, or violates most. What is not finite
/// has no value.
struct WorstRecord {
  std::optional<double> score;  ///< (value - bound) / scale: positive when violated
  std::optional<double> value;
  std::optional<double> bound;     ///< what value must not exceed, or fall below
  std::optional<double> rounding;  ///< how far value - bound may be from the true one
  double t = 0;                    ///< where that is, in hybrid time
  std::int64_t j = 0;
};

/// One claim over all runs.
struct ClaimRecord {
  std::string name;
  std::string kind;  ///< in words: "never increases"
  bool stated = true;
  std::vector<std::string> missing;  ///< what has no value; then all below is void
  bool sampled = true;
  std::uint64_t violations = 0;
  std::uint64_t undecided = 0;
  std::uint64_t worst_run = 0;
  WorstRecord worst;
  double tolerance = 0;
  double checked_down_to = 0;
};

/// A run, and why it did not reach the horizon or is undecided.
struct OpenRunRecord {
  std::uint64_t run = 0;
  std::string why;
};

struct CampaignRecord {
  CampaignVerdict verdict = CampaignVerdict::held;
  std::uint64_t runs = 0;
  std::uint64_t seed = 0;
  double horizon = 0;
  std::uint64_t violations = 0;
  std::uint64_t undecided = 0;
  std::uint64_t unfinished = 0;
  std::optional<OpenRunRecord> first_unfinished;
  std::optional<OpenRunRecord> first_undecided;
  std::uint64_t worst_run = 0;
  std::uint64_t repeated = 0;
  std::vector<std::uint64_t> confirmed;
  /// How many runs differ, where nothing is drawn; then there is no probability.
  std::optional<std::uint64_t> different_runs;
  std::optional<double> confidence;
  std::optional<double> violation_probability;  ///< at most, with that confidence
  std::vector<std::string> notes;
  std::vector<ClaimRecord> checks;
  std::optional<FiguresRecord> figures;  ///< when they were asked for
  std::uint64_t runs_asked = 0;          ///< more than `runs` after an interruption
  std::string message;                   ///< of an interruption
  std::string version;                   ///< of gainsmith
  std::string gains_hash;                ///< of the gain file that was verified (io::gains_hash)
};

}  // namespace gainsmith::model
