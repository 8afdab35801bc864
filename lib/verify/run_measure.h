// A figure (model/figure.h) as a number to be minimised: its mean over the first runs of a
// campaign.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "claims/track.h"
#include "model/gains.h"
#include "model/instance.h"

namespace gainsmith::verify {

/// (1/n) sum_k figure(run k), k = 0 ... n - 1, integrated to 1e-8: enough to tell values apart; and
/// the mean of the errors (statistics/bound_figure.h), by runs integrated to 1e-6. None where a run
/// has no such number, or an infinite one, or one that is not known: a value that never settles.
std::optional<claims::Bounded> mean_figure(const model::Instance& instance,
                                           const model::Gains& gains, const model::Figure& figure,
                                           std::uint64_t runs);

}  // namespace gainsmith::verify
