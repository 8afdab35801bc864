// Some runs of a campaign and all that is known of them, apart from the setup that made them: parts
// that were made on several machines, or before and after a stop, are added and concluded anywhere.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "claims/claim_check.h"
#include "claims/track.h"
#include "model/words.h"
#include "statistics/figure_survey.h"
#include "statistics/run_set.h"
#include "verify/tally.h"

namespace gainsmith::verify {

/// What is known of a claim without any run.
struct ClaimFacts {
  std::string name;
  model::ClaimKind kind = model::ClaimKind::nonincreasing;
  std::vector<std::string> missing;  ///< what has no value; none: the claim is stated
  std::string growing{};             ///< growing_mode()

  bool stated() const { return missing.empty(); }
  bool operator==(const ClaimFacts&) const = default;
};

/// What is the same for all parts of a campaign.
struct CampaignFacts {
  std::uint64_t asked = 0;  ///< runs of the whole campaign
  std::uint64_t seed = 0;
  double confidence = 0;
  double horizon = 0;
  bool many_at_once = false;    ///< runs are made in packs
  bool until_violated = false;  ///< ends with the first violated run; of no part of --shard
  std::optional<std::uint64_t> different;
  std::vector<std::string> events;  ///< a name; of a method of the program empty
  std::vector<std::string> doubts;
  std::vector<ClaimFacts> claims;

  bool operator==(const CampaignFacts&) const = default;
};

/// What a run is when it is made again.
struct Repeat {
  /// As the careful run finds it: of a claim's worst run that was made among many.
  struct Careful {
    std::vector<claims::Finding> findings;
    claims::Termination termination = claims::Termination::horizon;
    std::string message;

    bool operator==(const Careful&) const = default;
  };
  std::optional<Careful> careful;
  std::optional<bool> confirmed;  ///< whether it violates when repeated

  bool operator==(const Repeat&) const = default;
};

/// The sum of some runs. Parts with other runs add up to the same bits in any order (tally.h).
struct CampaignPart {
  CampaignFacts facts;
  statistics::RunSet runs;
  Tally tally;
  std::map<std::uint64_t, Repeat> repeats;  ///< by run: the worst runs of the part
  statistics::SurveyOfRuns figures;         ///< where they are asked for

  /// Whether it has the run that ends the campaign before all runs are made.
  bool ended() const { return facts.until_violated && tally.violations > 0; }

  bool operator==(const CampaignPart&) const = default;
};

/// Adds a part of the same campaign with other runs. Those runs of it that are there already: none,
/// or the first of them; then nothing is added.
statistics::RunRange add(const CampaignPart& more, CampaignPart& sum);

}  // namespace gainsmith::verify
