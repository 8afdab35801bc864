// A claim with what a campaign says of it.
#pragma once

#include <ostream>
#include <string>

#include "verify/campaign.h"

namespace gainsmith::verify {

struct Case {
  std::string claim;
  model::CampaignVerdict verdict;
};
inline void PrintTo(const Case& one, std::ostream* out) { *out << one.claim; }

}  // namespace gainsmith::verify
