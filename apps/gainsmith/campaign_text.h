// Campaigns as text and JSON.
#pragma once

#include <string>
#include <vector>

#include "base/error.h"
#include "model/campaign_record.h"
#include "verify/campaign.h"

namespace gainsmith::app {

/// "never increases".
std::string kind_text(model::ClaimKind kind);

/// yes of a campaign that held, no of a violated one.
ExitCode campaign_exit(model::CampaignVerdict verdict);

/// `gains_hash`: of the gains that were verified (io/json/campaign_json.h).
model::CampaignRecord campaign_record(const verify::Report& report, const std::string& gains_hash);

/// Verdict, checks and how to replay the worst run; `gains_file` is named in the command, with
/// its --set options.
std::string campaign_summary(const verify::Report& report, const std::string& gains_file);

/// Of a claim that the end of a run leaves open, or violates:
/// "ended at (t, j) = (1.25, 0), before ...".
std::string end_text(const claims::Finding& finding);

/// Why a campaign did not hold, a line each with the command that repeats the run: the claims that
/// are violated, the one violated most at first, or the first undecided run. Empty when it held.
std::vector<std::string> campaign_causes(const verify::Report& report,
                                         const std::string& gains_file);

/// "interrupted after 1234 of 10000 runs: 1230 held, 4 violated; ...".
std::string interruption_text(const verify::Report& report);

/// One line: "held in 1000 runs, worst run 627".
std::string campaign_line(const model::CampaignRecord& record);

}  // namespace gainsmith::app
