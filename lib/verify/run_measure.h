// A figure (model/figure.h) as a number to be minimised: its mean over the first runs of a
// campaign.
#pragma once

#include <cstdint>
#include <optional>

#include "model/gains.h"
#include "model/instance.h"

namespace gainsmith::verify {

/// (1/n) sum_k figure(run k), k = 0 ... n - 1, integrated to 1e-8: enough to tell values apart.
/// None where a run has no such number, or an infinite one: a value that never settles.
std::optional<double> mean_figure(const model::Instance& instance, const model::Gains& gains,
                                  const model::Figure& figure, std::uint64_t runs);

/// The mean of the errors (statistics/bound_figure.h) of these numbers; infinite where one is not
/// known.
double mean_error(const model::Instance& instance, const model::Gains& gains,
                  const model::Figure& figure, std::uint64_t runs);

}  // namespace gainsmith::verify
