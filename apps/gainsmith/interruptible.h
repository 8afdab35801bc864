// Work that Ctrl-C ends with what is known, not with the program.
#pragma once

#include <stdexcept>
#include <string>

#include "verify/campaign.h"

namespace gainsmith::app {

/// Thrown out of work that Ctrl-C ended; what() says what was done.
class Interrupted : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// verify::run_campaign. After catch_interrupts(), Ctrl-C ends it between blocks of runs:
/// Interrupted says how many are done. A campaign without all its runs has no verdict.
verify::Report interruptible_campaign(const model::Instance& instance, const model::Gains& gains,
                                      verify::CampaignOptions options);

}  // namespace gainsmith::app
