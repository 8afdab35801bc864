// Monte-Carlo: many runs against the claims of a gain file.
//
// Verify shares no code with the synthesis: it knows the gains, the method's text and the plant.
//
// Run k draws from its own streams (hybrid/scenario.h). With K violations in N runs the
// Clopper-Pearson bound limits the probability of a violation (statistics/sample_bounds.h). A held
// campaign is evidence for its sampling laws, and no proof.
//
//   setup, coordinate_states, error_states   dynamics in coordinates without cancellation
//   judge, pack_judge        the verdict on one run, by the careful run or by packs
//   campaign, campaign_part, tally, conclude   many runs, their sum, and the report
//   worst, draw_cube, periodic_lengths   the search for a run that violates
//   growing                  which eigenvalue makes a claim fail
//   replay, expected_run, run_measure   single runs: tables, expected figures, a cost to minimise
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "claims/claim_check.h"
#include "claims/track.h"
#include "model/words.h"
#include "packs/pack_runner.h"
#include "verify/campaign_part.h"
#include "verify/pack_judge.h"
#include "verify/setup.h"
#include "verify/tally.h"

namespace gainsmith::verify {

using Save = std::function<void()>;

struct CampaignOptions {
  std::optional<std::uint64_t> runs;  ///< none: the problem's
  std::optional<std::uint64_t> seed;  ///< none: the problem's
  unsigned threads = 0;               ///< 0: one a core; the report does not depend on it
  double confidence = 0.95;           ///< of the bound on the probability of a violation
  /// The campaign ends with the first run, in the order of their numbers, that violates a claim.
  bool until_violated = false;
  /// More work on the runs that are made so far, as many as it is told. It is called after the
  /// first runs, and where runs are made one by one whenever there are about twice as many.
  std::function<void(std::uint64_t)> between{};
};

/// One claim over all runs.
struct CheckReport {
  std::string name;
  model::ClaimKind kind = model::ClaimKind::nonincreasing;
  bool stated = true;  ///< false: not checked, because `missing` have no value
  std::vector<std::string> missing;
  std::uint64_t violations = 0;
  std::uint64_t undecided = 0;
  /// Violating runs first, then undecided ones, then by score; ties to the lowest.
  std::uint64_t worst_run = 0;
  claims::Finding worst;  ///< in that run
  bool measured = true;   ///< false after a stop: of `worst` the judgement and the score are known
  double floor = 0;       ///< the largest Finding::floor
};

struct Report {
  model::CampaignVerdict verdict = model::CampaignVerdict::held;
  std::uint64_t runs = 0;   ///< that were made
  std::uint64_t asked = 0;  ///< that were to be made: no run twice
  bool ended = false;       ///< by its first violated run, as it was to be
  std::uint64_t seed = 0;
  std::uint64_t violations = 0;  ///< runs that violate a claim or do not reach the horizon
  std::uint64_t undecided = 0;   ///< runs of which neither is certain when repeated
  std::uint64_t unfinished = 0;  ///< runs that do not reach the horizon; of the first of them:
  std::uint64_t unfinished_run = 0;
  claims::Termination unfinished_termination = claims::Termination::horizon;
  std::string unfinished_message;  ///< why it ended
  /// Of runs that were made many at once: how many the careful run has decided, and by
  /// packs::Why those that were left open. None where all runs are made one by one.
  std::optional<std::uint64_t> careful;
  std::array<std::uint64_t, packs::kWhys> open{};
  /// The first of the undecided runs; where they are violations that do not happen again when
  /// repeated, the worst of these.
  std::optional<UndecidedRun> first_undecided;
  std::uint64_t repeated = 0;  ///< runs that were repeated more accurately
  /// The repeated runs that violate again, in order. The worst run of the campaign and that of each
  /// claim are repeated if they violate.
  std::vector<std::uint64_t> confirmed;
  /// The worst run; of a campaign that held, the one nearest to a violation. In order of
  /// precedence: it violates; it does not reach the horizon; it is undecided; the largest score of
  /// a claim, of those that it violates if any. Ties go to the lowest number.
  std::uint64_t worst_run = 0;
  double horizon = 0;
  /// How many different runs there are, where nothing is drawn at random (hybrid/idle.h): then no
  /// run says anything of another.
  std::optional<std::uint64_t> different;
  double confidence = 0.95;
  /// With that confidence the probability that a run of this campaign violates is at most this;
  /// undecided runs count as violating. 1 where nothing is drawn.
  double violation_probability = 1;
  std::vector<std::string> silent_events;  ///< of the user's text, that happened in no run
  std::vector<std::string> doubts;         ///< hybrid/doubts.h
  std::string growing;  ///< of a violated campaign: why, where the dynamics tell (growing.h)
  std::vector<CheckReport> checks;  ///< in the method's order; none when no run was made

  bool interrupted() const { return runs < asked && !ended; }
};

class Collector;

/// Makes the runs of a campaign, or a part of them. The setup must outlive it.
class Campaign {
 public:
  /// InputError for 0 runs, and when no claim is stated.
  Campaign(const Setup& setup, const CampaignOptions& options);

  /// Without runs.
  CampaignPart begin() const { return {facts_, {}, {}, {}, {}}; }
  std::uint64_t asked() const { return facts_.asked; }

  /// Adds those of these runs that the part has not; after a stop (base/stop.h) those that were
  /// made. `save` is called now and then, on any thread, one at a time: meanwhile the part does
  /// not change. A campaign until its first violated run begins with run 0, and has those up to it.
  void make_runs(statistics::RunRange range, CampaignPart& part, const Save& save = {}) const;

  /// Adds what conclude() asks of the worst runs. Of a campaign that was stopped they are not
  /// confirmed, and repeated only as far as half a second goes. Stopped (base/stop.h) where
  /// something is left to do.
  void repeat_worst(CampaignPart& part) const;

 private:
  /// Whether packs have decided at least half of the first runs.
  bool packs_go_on(const PackJudge& first) const;
  /// Makes the runs of a range in blocks of `size` on threads. `prepared`: a judge that has these
  /// runs already, or nullptr. Stopped after a stop.
  void make_range(statistics::RunRange range, const Packs* packs, const PackJudge* prepared,
                  std::uint64_t size, Collector& collector) const;

  const Setup* setup_;
  unsigned threads_;
  std::function<void(std::uint64_t)> between_;
  Packs packs_;
  CampaignFacts facts_;
};

/// The report on the runs of a part, with what it holds of the worst of them.
Report conclude(const CampaignPart& part);

/// Simulates all runs and checks every claim that the gain file states (judge.h). The verdict is
/// `violated` when the worst run violates and does so again when it is repeated, `held` when every
/// run holds, and `undecided` otherwise. A stop (base/stop.h) leaves it undecided, with the runs
/// that were done. InputError for 0 runs, and when no claim is stated.
Report run_campaign(const Setup& setup, const CampaignOptions& options = {});

}  // namespace gainsmith::verify
