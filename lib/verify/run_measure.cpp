#include "verify/run_measure.h"

#include <cmath>

#include "base/stop.h"
#include "bind/stated.h"
#include "statistics/bound_figure.h"

namespace gainsmith::verify {

std::optional<double> mean_figure(const model::Instance& instance, const model::Gains& gains,
                                  const model::Figure& figure, std::uint64_t runs) {
  const auto setup = claims::make_run_setup(bind::run_texts(instance, gains));
  simulate::Simulator simulator(setup->system, setup->scenario);
  statistics::BoundFigure bound(figure, *setup);
  const simulate::Accuracy accuracy = setup->accuracy(claims::kAccuracyOfMany);
  double sum = 0;
  for (std::uint64_t run = 0; run < runs; ++run) {
    const auto trajectory = simulator.run(instance.design->campaign.seed, run, accuracy);
    check_stop();
    const auto number = bound.of(trajectory);
    if (!number || !std::isfinite(*number)) return std::nullopt;
    sum += *number;
  }
  return sum / static_cast<double>(runs);
}

double mean_error(const model::Instance& instance, const model::Gains& gains,
                  const model::Figure& figure, std::uint64_t runs) {
  const auto setup = claims::make_run_setup(bind::run_texts(instance, gains));
  claims::TwinRuns twins(*setup);
  statistics::BoundFigure bound(figure, *setup);
  constexpr double kCoarser = 1 / claims::kSharper;
  double sum = 0;
  for (std::uint64_t run = 0; run < runs; ++run)
    sum += bound.of(twins(instance.design->campaign.seed, run, claims::kAccuracyOfMany, kCoarser))
               .error;
  return sum / static_cast<double>(runs);
}

}  // namespace gainsmith::verify
