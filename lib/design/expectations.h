// Comparison of a result with what a problem expects.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/gains.h"
#include "model/instance.h"

namespace gainsmith::design {

/// Whether the verdict is not yes where yes, or another word, is expected: then there is nothing
/// else to compare.
bool lacks_gains(const model::Design& design, const model::Gains& gains);

/// The differences between what `expect:` says and what was found, one sentence each, with the
/// place in the problem file; empty when all is as expected. Where it does not say, no certificate
/// may exclude gains and the campaign must not be violated. Where it lacks gains the
/// verdict alone. `campaign` is none when no campaign was run; an expectation on it is then a
/// difference.
std::vector<std::string> differences(const model::Instance& instance, const model::Gains& gains,
                                     std::optional<model::CampaignVerdict> campaign);

}  // namespace gainsmith::design
