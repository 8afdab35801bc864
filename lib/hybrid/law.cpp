#include "hybrid/law.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "base/number.h"
#include "hybrid/tolerances.h"

namespace gainsmith::hybrid {

namespace {

using model::LawKind;

double checked_value(const Place& place, double value, double low, double high) {
  const double slack = kAddedUp * high;
  if (!(value >= low - slack && value <= high + slack))
    throw InputError(place,
                     fmt::format("the sampling interval {} is outside the timer's range [{}, {}]",
                                 brief(value), brief(low), brief(high)));
  return std::clamp(value, low, high);
}

}  // namespace

double Law::reset_value(std::size_t jump, double t, RandomStream& random) const {
  switch (kind) {
    case LawKind::constant:
      return values.front();
    case LawKind::uniform:
      return low + (high - low) * random.uniform();
    case LawKind::extremes:
      return random.uniform() < 0.5 ? low : high;
    case LawKind::sinusoid:
      // A sine of the time since the start, of angular frequency 1/high.
      return sinusoid_of(sine(t / high), low, high);
    case LawKind::list:
      return values[jump % values.size()];
    case LawKind::golden: {
      // low + (high - low) frac((jump + 1) phi), phi = (sqrt(5) - 1)/2: a sequence of low
      // discrepancy.
      constexpr double golden_ratio = 0.6180339887498949;
      const double turns = static_cast<double>(jump + 1) * golden_ratio;
      return low + (high - low) * (turns - std::floor(turns));
    }
  }
  return high;
}

std::vector<Law> make_laws(const std::vector<model::Design::Law>& given, double low, double high,
                           const System& system) {
  if (given.empty()) {
    std::vector<Law> usual = {{LawKind::uniform, low, high, {}},
                              {LawKind::extremes, low, high, {}},
                              {LawKind::sinusoid, low, high, {}},
                              {LawKind::constant, low, high, {low}},
                              {LawKind::constant, low, high, {high}}};
    // Lengths that are 0, or fall to 0 at t = 3 pi/2 high, never reach the horizon.
    if (low == 0) usual.erase(usual.begin() + 2, usual.begin() + 4);
    return usual;
  }
  std::vector<Law> laws;
  for (const model::Design::Law& law : given) {
    Law result{law.kind, low, high, {}};
    for (const model::Formula& formula : law.values)
      result.values.push_back(checked_value(formula.place, system.scalar(formula), low, high));
    const bool needs_values = law.kind == LawKind::constant || law.kind == LawKind::list;
    if (needs_values && result.values.empty())
      throw InputError(law.place, "the sampling law " + model::to_string(law.kind) +
                                      " needs at least one interval");
    laws.push_back(std::move(result));
  }
  return laws;
}

}  // namespace gainsmith::hybrid
