// What `verify --json` prints and `run` writes as campaign.json.
#pragma once

#include <string>

#include "io/json/json_text.h"
#include "model/campaign_record.h"
#include "model/gains.h"

namespace gainsmith::io {

/// The document of a campaign, which parse_campaign() reads back.
Json to_json(const model::CampaignRecord& record);

/// Reads a campaign. InputError with the place when it is truncated, lacks a key, or holds an
/// unknown one or a value of the wrong kind.
model::CampaignRecord parse_campaign(const std::string& text, const std::string& file);

/// sha256 of a gain file's text without its timings: which gains a campaign is about.
std::string gains_hash(const model::Gains& gains);

}  // namespace gainsmith::io
