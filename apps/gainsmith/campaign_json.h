// Parts of campaigns as JSON: every number is read back to the same bits.
#pragma once

#include <string>

#include "io/json/json_reader.h"
#include "io/json/json_text.h"
#include "verify/campaign_part.h"

namespace gainsmith::app {

io::Json to_json(const verify::CampaignFacts& facts);
verify::CampaignFacts facts_from(const io::JsonReader& reader);

/// What the runs were: their numbers, their tally, figures over them.
io::Json runs_json(const verify::CampaignPart& part);
/// Into a part with its facts.
void read_runs(const io::JsonReader& reader, verify::CampaignPart& part);

io::Json repeats_json(const verify::CampaignPart& part);
void read_repeats(const io::JsonReader& reader, verify::CampaignPart& part);

}  // namespace gainsmith::app
