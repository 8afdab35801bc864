#include "hybrid/idle.h"

#include <algorithm>
#include <numeric>

namespace gainsmith::hybrid {

namespace {

using model::Dynamics;

/// How many values a draw takes in turn, run after run; 0: it is random.
std::uint64_t values_of(const StartRule& rule) {
  using Kind = model::StartKind;
  if (rule.kind == Kind::list) return rule.values.size();
  if (rule.kind == Kind::box) return rule.values[0] == rule.values[1] ? 1 : 0;
  if (has_center(rule.kind) && rule.kind != Kind::ellipsoid)
    return rule.values[1].isZero(0) ? 1 : 0;
  return rule.kind == Kind::expression ? 1 : 0;
}

/// Vertices: run k takes element k/stride modulo their number, so the period is stride times that.
std::uint64_t values_of(const Dynamics::Noise& noise, const System::NoiseValues& rule) {
  if (noise.has_center()) return rule.values[1].isZero(0) ? 1 : 0;
  if (noise.kind == Dynamics::NoiseKind::uniform) return rule.values[0] == rule.values[1] ? 1 : 0;
  return rule.stride * rule.values.size();
}

/// Run k takes law k modulo their number. The laws uniform and extremes draw; the others do not.
std::uint64_t values_of(const std::vector<Law>& laws) {
  const bool drawn =
      laws.empty() || std::any_of(laws.begin(), laws.end(), [](const Law& law) {
        return law.kind == model::LawKind::uniform || law.kind == model::LawKind::extremes;
      });
  return drawn ? 0 : laws.size();
}

/// Of the clock of an event, and of its losses.
std::uint64_t values_of_event(std::size_t event, const System& system, const Scenario& scenario) {
  if (system.dynamics.events[event].lost > 0) return 0;
  const auto& clock = system.clocks[event];
  if (!clock) return 1;
  const bool first_given = event < scenario.first.size() && scenario.first[event];
  if (!first_given && clock->first && clock->first->first < clock->first->second) return 0;
  return clock->low < clock->high ? values_of(scenario.laws[event]) : 1;
}

}  // namespace

/// By the earliest first time that a clock may draw. Other events have none.
std::vector<std::size_t> late_events(const System& system, const Scenario& scenario) {
  std::vector<std::size_t> late;
  for (std::size_t e = 0; e < system.dynamics.events.size(); ++e) {
    std::optional<double> first;
    if (!system.times[e].empty()) first = system.times[e].front();
    if (const auto& clock = system.clocks[e])
      first = e < scenario.first.size() && scenario.first[e] ? *scenario.first[e]
              : clock->first                                 ? clock->first->first
                                                             : clock->low;
    if (first && *first > scenario.horizon) late.push_back(e);
  }
  return late;
}

/// The least common multiple of the periods of all draws. One random draw, or a period above 10^9
/// runs, leaves none.
std::optional<std::uint64_t> different_runs(const System& system, const Scenario& scenario) {
  constexpr std::uint64_t kMostRuns = 1000000000;
  std::uint64_t all = 1;
  const auto add = [&](std::uint64_t values) {
    all = all == 0 || values == 0 || values > kMostRuns ? 0 : std::lcm(all, values);
    if (all > kMostRuns) all = 0;  // none of them is made twice
  };
  for (const auto& start : scenario.starts)
    if (start) add(values_of(*start));
  for (std::size_t e = 0; e < system.dynamics.events.size(); ++e)
    add(values_of_event(e, system, scenario));
  for (std::size_t i = 0; i < system.noise.size(); ++i)
    add(values_of(system.dynamics.noise[i], system.noise[i]));
  return all > 0 ? std::optional(all) : std::nullopt;
}

}  // namespace gainsmith::hybrid
