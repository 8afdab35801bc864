#include "verify/run_measure.h"

#include <cmath>

#include "bind/stated.h"
#include "statistics/bound_figure.h"

namespace gainsmith::verify {

std::optional<claims::Bounded> mean_figure(const model::Instance& instance,
                                           const model::Gains& gains, const model::Figure& figure,
                                           std::uint64_t runs) {
  const auto setup = claims::make_run_setup(bind::run_texts(instance, gains));
  claims::TwinRuns make(*setup);
  statistics::BoundFigure bound(figure, *setup);
  claims::Bounded sum;
  for (std::uint64_t run = 0; run < runs; ++run) {
    const statistics::Estimate found = bound.of(
        make(instance.design->campaign.seed, run, claims::kAccuracyOfMany, 1 / claims::kSharper));
    if (!found.known() || !found.value || !std::isfinite(*found.value)) return std::nullopt;
    sum.value += *found.value;
    sum.bound += found.error;
  }
  const auto count = static_cast<double>(runs);
  return claims::Bounded{sum.value / count, sum.bound / count};
}

}  // namespace gainsmith::verify
