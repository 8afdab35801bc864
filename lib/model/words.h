// Answers, in the words of the architecture.
#pragma once

#include <string>

namespace gainsmith::model {

/// The answer to "are there gains that satisfy every inequality?".
enum class Verdict { yes, no, undecided };
std::string to_string(Verdict verdict);

/// The answer of a campaign.
enum class CampaignVerdict { held, violated };
std::string to_string(CampaignVerdict verdict);

}  // namespace gainsmith::model
