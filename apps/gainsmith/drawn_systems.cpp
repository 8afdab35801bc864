#include "gainsmith/drawn_systems.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/number.h"
#include "bind/stated.h"
#include "expr/program/evaluate.h"

namespace gainsmith::app {

namespace {

using model::SystemFigure;
using model::SystemPicture;
using response::StateSpace;

bool is_over_frequency(SystemPicture kind) {
  return kind_of(kind).over == model::PictureRange::frequency;
}
bool is_over_time(SystemPicture kind) { return kind_of(kind).over == model::PictureRange::time; }

/// Nothing where a gain of it has no value.
std::optional<StateSpace> value_of(const SystemFigure::System& of, const model::Stated& stated) {
  try {
    const auto matrix = stated.value(of.matrix);
    if (!matrix) return std::nullopt;
    // Of larger ones products are beyond the range of double.
    constexpr double kLargest = 1e100;
    if (!(matrix->array().abs() <= kLargest).all())
      throw InputError(of.place, "'" + of.label + "' has elements beyond 1e100, or not finite");
    double step = 0;
    if (of.step) {
      const auto value = stated.value(*of.step);
      if (!value) return std::nullopt;
      step = (*value)(0, 0);
      if (!(step > 0) || !std::isfinite(step))
        throw InputError(of.place, "the sampling time of '" + of.label +
                                       "' must be positive, not " + brief(step));
    }
    return response::state_space(*matrix, of.states, step);
  } catch (const expr::EvaluationError& error) {
    throw InputError(of.place, "'" + of.label + "' has no value: " + error.message());
  }
}

std::pair<double, double> given_range(const SystemFigure& figure, const model::Stated& stated) {
  const auto end = [&](const model::Formula& formula) {
    const auto value = stated.value(formula.program);
    if (!value) throw InputError(formula.place, "over: this end has no value");
    return (*value)(0, 0);
  };
  const std::pair<double, double> range{end(figure.over->first), end(figure.over->second)};
  const bool positive = is_over_frequency(figure.kind);
  if (!(range.first < range.second) || (positive ? !(range.first > 0) : range.first != 0))
    throw InputError(figure.over->first.place,
                     positive ? "over: a range of frequencies is positive and rises"
                              : "over: a range of times begins at 0 and rises");
  return range;
}

}  // namespace

model::Stated nominal(const LoadedGains& loaded) {
  const std::string plant = "plant.";
  model::Stated stated = bind::state(loaded.stated, loaded.gains);
  for (const model::Dynamics::Noise& noise : loaded.stated.design->varied.noise)
    stated.values[noise.name] = stated.values.at(noise.name.substr(plant.size()));
  return stated;
}

std::optional<std::vector<DrawnSystem>> systems_of(const SystemFigure& figure,
                                                   const model::Stated& stated,
                                                   std::string& missing) {
  std::vector<DrawnSystem> systems;
  for (const SystemFigure::System& of : figure.systems) {
    auto system = value_of(of, stated);
    if (!system) {
      missing =
          "'" + of.label + "' uses what has no value, such as a gain of a design without solution";
      return std::nullopt;
    }
    DrawnSystem& drawn = systems.emplace_back();
    drawn.label = of.label;
    drawn.system = std::move(*system);
  }
  return systems;
}

std::pair<double, double> range_of(const SystemFigure& figure, const model::Stated& stated,
                                   const std::vector<DrawnSystem>& systems) {
  if (!is_over_frequency(figure.kind) && !is_over_time(figure.kind)) return {0, 0};
  if (figure.over) return given_range(figure, stated);
  std::pair<double, double> range{std::numeric_limits<double>::infinity(), 0};
  for (const DrawnSystem& drawn : systems) {
    const auto own = is_over_time(figure.kind) ? std::pair(0.0, response::duration_of(drawn.system))
                     : drawn.system.is_single() ? response::range_with_crossover(drawn.system)
                                                : response::range_of(drawn.system);
    range.first = std::min(range.first, own.first);
    range.second = std::max(range.second, own.second);
  }
  return range;
}

void compute(const SystemFigure& figure, std::pair<double, double> range, DrawnSystem& drawn) {
  const StateSpace& system = drawn.system;
  if (is_over_frequency(figure.kind)) {
    const double most = system.is_sampled() ? response::range_of(system).second
                                            : std::numeric_limits<double>::infinity();
    if (!(range.first < most))
      throw InputError(figure.place, "figures: " + figure.name +
                                         ": the range begins above half of the sampling frequency");
    drawn.sweep = response::sweep(system, range.first, std::min(range.second, most));
    if (figure.kind != SystemPicture::singular_values && system.is_single())
      drawn.margins = response::margins(system);
    if (figure.kind == SystemPicture::singular_values || !system.is_single())
      drawn.peak = response::peak(system);
  } else if (is_over_time(figure.kind)) {
    const auto stimulus =
        figure.kind == SystemPicture::step ? response::Stimulus::step : response::Stimulus::impulse;
    for (Eigen::Index j = 0; j < system.inputs(); ++j)
      drawn.time.push_back(response::time_response(system, stimulus, j, range.second));
  } else if (figure.kind == SystemPicture::margins) {
    drawn.margins = response::margins(system);
  } else {
    drawn.poles = response::poles(system);
    drawn.zeros = response::zeros(system);
  }
}

}  // namespace gainsmith::app
