#include "hybrid/given_run.h"

#include <fmt/format.h>

#include <utility>

#include "base/number.h"
#include "hybrid/scenario.h"
#include "hybrid/tolerances.h"

namespace gainsmith::hybrid {

namespace {

void check_shape(const numbers::Matrix& value, expr::Shape shape, const std::string& what,
                 const Place& place) {
  if (value.rows() != shape.rows || value.cols() != shape.cols)
    throw InputError(place, fmt::format("{} is {} x {}: expected {} x {}", what, value.rows(),
                                        value.cols(), shape.rows, shape.cols));
  if (!value.allFinite()) throw InputError(place, what + " is not finite");
}

void check_time(double time, std::pair<double, double> range, const std::string& what,
                const Place& place) {
  const auto [low, high] = range;
  if (!(time >= low - kAddedUp * high && time <= high + kAddedUp * high))
    throw InputError(place, fmt::format("{} is {}, outside its range [{}, {}]", what, brief(time),
                                        brief(low), brief(high)));
}

void check_starts(const GivenRun& given, const System& system, const Scenario& scenario) {
  for (std::size_t i = 0; i < given.starts.size(); ++i) {
    if (!given.starts[i]) continue;
    const Slot& slot = system.layout.slots[i];
    const auto& rule = scenario.starts[i];
    if (!rule || rule->kind == model::StartKind::expression)
      throw InputError(given.place, "the start of " + slot.name +
                                        " is not drawn: the problem gives it by an expression");
    check_shape(*given.starts[i], slot.shape, "the start of " + slot.name, given.place);
  }
}

void check_event(const GivenRun& given, std::size_t event, const System& system) {
  const model::Dynamics::Event& one = system.dynamics.events[event];
  const auto& clock = system.clocks[event];
  const auto refuse = [&](const std::string& what) {
    throw InputError(given.place, fmt::format("{} of {} is not drawn", what, one.name));
  };
  const auto first = GivenRun::of(given.first, event);
  if (first && !(clock && clock->first)) refuse("the first time");
  if (first) check_time(*first, *clock->first, "the first time of " + one.name, given.place);
  const auto lengths = GivenRun::of(given.lengths, event);
  if (!lengths.empty() && !(clock && clock->low < clock->high)) refuse("the length");
  for (const double length : lengths)
    check_time(length, {clock->low, clock->high}, "a length of " + one.name, given.place);
  if (!GivenRun::of(given.losses, event).empty() && one.lost == 0) refuse("the loss");
}

}  // namespace

void check_given(const GivenRun& given, const System& system, const Scenario& scenario) {
  check_starts(given, system, scenario);
  for (std::size_t e = 0; e < system.dynamics.events.size(); ++e) check_event(given, e, system);
  for (std::size_t i = 0; i < given.noise.size(); ++i)
    for (const numbers::Matrix& value : given.noise[i])
      check_shape(value, system.dynamics.noise[i].shape,
                  "a value of " + system.dynamics.noise[i].name, given.place);
}

}  // namespace gainsmith::hybrid
