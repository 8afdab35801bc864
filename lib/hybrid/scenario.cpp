#include "hybrid/scenario.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/number.h"
#include "hybrid/event_functions.h"
#include "hybrid/tolerances.h"

namespace gainsmith::hybrid {

namespace {

using Eigen::VectorXd;
using model::Dynamics;
using model::StartKind;

constexpr double never = std::numeric_limits<double>::infinity();

bool is_drawn(const Dynamics::Variable& variable) {
  return variable.kind == Dynamics::VariableKind::state ||
         variable.kind == Dynamics::VariableKind::mode;
}

/// InputError when the text uses a variable that has no value yet.
void check_start(const model::Formula& formula, std::size_t variable, const System& system) {
  for (const expr::Input& input : formula.program.inputs) {
    const auto slot = system.slot(input.name);
    if (slot && *slot >= variable &&
        system.dynamics.variables[*slot].kind != Dynamics::VariableKind::noise)
      throw InputError(formula.place, "the initial value of " + system.layout.slots[variable].name +
                                          " uses " + input.name + ", which has no value yet");
    if (!slot && !system.constants.contains(input.name))
      throw InputError(formula.place, "there is no value for " + input.name);
  }
}

StartRule rule_of(const model::Design::Start& start, const System& system) {
  const Slot& slot = system.layout.slots[start.state];
  StartRule rule{start.kind, {}, {}, start.place};
  if (start.kind == StartKind::expression) {
    check_start(start.values.front(), start.state, system);
    rule.program = start.values.front().program;
    return rule;
  }
  const bool around = has_center(start.kind);
  for (const model::Formula& formula : start.values) {
    numbers::Matrix value = system.value(formula);
    if (around && !rule.values.empty())
      value = spread_map(value, start.covariance, slot.shape.size(), slot.name, formula.place);
    else if ((around || start.kind == StartKind::box) && value.size() == 1)
      value = numbers::Matrix::Constant(slot.shape.rows, slot.shape.cols, value(0, 0));
    rule.values.push_back(std::move(value));
  }
  if (start.kind == StartKind::box && (rule.values[0].array() > rule.values[1].array()).any())
    throw InputError(start.place, "the box of " + slot.name + " is empty: low > high");
  if (start.kind == StartKind::ellipsoid) read_ellipsoid(rule, slot.name);
  return rule;
}

/// The box [-1, 1], of a state beside a timer of which nothing says where it starts.
StartRule default_box(const Dynamics::Variable& variable) {
  const auto all = [&](double value) {
    return numbers::Matrix(
        numbers::Matrix::Constant(variable.shape.rows, variable.shape.cols, value));
  };
  return {StartKind::box, {all(-1), all(1)}, {}, variable.place};
}

}  // namespace

bool starts_in_a_box(const Dynamics& dynamics, const Dynamics::Variable& state) {
  return dynamics.has_timer && state.kind == Dynamics::VariableKind::state &&
         state.structure != model::Structure::symmetric;
}

namespace {

/// Rules for all states, from those of a campaign and from where the dynamics say.
std::vector<std::optional<StartRule>> rules_of(const std::vector<model::Design::Start>& starts,
                                               const System& system) {
  std::vector<std::optional<StartRule>> rules;
  const auto& variables = system.dynamics.variables;
  for (std::size_t i = 0; i < variables.size(); ++i) {
    rules.emplace_back();
    if (!is_drawn(variables[i])) continue;
    const auto found = std::find_if(starts.begin(), starts.end(),
                                    [&](const auto& start) { return start.state == i; });
    if (found != starts.end()) {
      rules.back() = rule_of(*found, system);
    } else if (variables[i].start) {
      rules.back() = rule_of(
          {i, StartKind::expression, {*variables[i].start}, variables[i].start->place}, system);
    } else if (variables[i].shape.size() == 0 || starts_in_a_box(system.dynamics, variables[i])) {
      rules.back() = default_box(variables[i]);
    } else {
      throw InputError(variables[i].place,
                       "the state '" + variables[i].name +
                           "' has no start, and a run needs one: {shape: ..., start: ...}, or "
                           "under campaign.initial of the problem");
    }
  }
  return rules;
}

/// low + (high - low) u element by element, u uniform in [0, 1). Of a symmetric state the lower
/// triangle is drawn and mirrored.
numbers::Matrix box_value(const StartRule& rule, bool symmetric, RandomStream& random) {
  numbers::Matrix value = rule.values[0];
  for (Eigen::Index j = 0; j < value.cols(); ++j)
    for (Eigen::Index i = symmetric ? j : 0; i < value.rows(); ++i) {
      const double low = rule.values[0](i, j);
      value(i, j) = low + (rule.values[1](i, j) - low) * random.uniform();
      if (symmetric) value(j, i) = value(i, j);
    }
  return value;
}

/// InputError for a mode that is no whole number and for an asymmetry above kMeantEqual of the
/// largest element. A smaller one is removed: (P + P')/2.
void check_value(const Dynamics::Variable& variable, const Place& place, numbers::Matrix& value) {
  if (variable.kind == Dynamics::VariableKind::mode && value(0) != std::round(value(0)))
    throw InputError(place, "the mode " + variable.name + " starts at " + brief(value(0), 17) +
                                ": expected a whole number");
  if (variable.structure != model::Structure::symmetric || value.size() == 0) return;
  const double asymmetry = (value - value.transpose()).cwiseAbs().maxCoeff();
  if (asymmetry > kMeantEqual * value.cwiseAbs().maxCoeff())
    throw InputError(place, "the state " + variable.name +
                                " is symmetric and its start is not: elements differ by " +
                                brief(asymmetry));
  value = ((value + value.transpose()) / 2).eval();
}

}  // namespace

Scenario make_scenario(double horizon, const System& system) {
  Scenario scenario;
  scenario.horizon = horizon;
  scenario.starts = rules_of({}, system);
  scenario.laws.resize(system.dynamics.events.size());
  scenario.first.resize(system.dynamics.events.size());
  return scenario;
}

namespace {

/// The laws of one event: its own, otherwise those of all.
std::vector<model::Design::Law> laws_of(std::size_t event, std::vector<model::Design::Law> laws) {
  const auto is_own = [&](const model::Design::Law& law) { return law.event == event; };
  const bool own = std::ranges::any_of(laws, is_own);
  std::erase_if(laws, [&](const auto& law) { return own ? !is_own(law) : law.event.has_value(); });
  return laws;
}

/// Of runs of which nothing says how long they are: so many of the longest lengths. 0 without a
/// timer.
double default_horizon(const System& system) {
  constexpr double intervals = 40;
  double longest = 0;
  for (const auto& clock : system.clocks)
    if (clock && system.dynamics.has_timer) longest = std::max(longest, clock->high);
  return intervals * longest;
}

/// Where no horizon is given a run of measured data goes to their end.
double horizon_of(const model::Design::Campaign& campaign, const System& system) {
  const auto& measured = system.dynamics.measured;
  double end = never;
  for (const Dynamics::Measured& one : measured) end = std::min(end, one.series->times.back());
  if (measured.empty()) end = default_horizon(system);
  if (!campaign.horizon && end == 0)
    throw InputError(campaign.place, "the campaign has no horizon");
  const double horizon = campaign.horizon ? system.scalar(*campaign.horizon) : end;
  const Place& place = campaign.horizon ? campaign.horizon->place : campaign.place;
  if (!(horizon > 0 && std::isfinite(horizon)))
    throw InputError(place, "the horizon is " + brief(horizon) + ": expected a positive time");
  for (const Dynamics::Measured& one : measured)
    if (one.between == model::Between::line && horizon > one.series->times.back())
      throw InputError(place, "the horizon " + brief(horizon) + " lies after the last row of " +
                                  one.name + ", t = " + brief(one.series->times.back()) + " in " +
                                  one.series->file);
  return horizon;
}

/// What a campaign says of the first time, within the range that the dynamics say.
double first_of(const model::Formula& formula, const System::Clock& clock, const System& system) {
  const double first = system.scalar(formula);
  if (!clock.first) return first;
  const auto [low, high] = *clock.first;
  if (!(first >= low - kAddedUp * high && first <= high + kAddedUp * high))
    throw InputError(formula.place,
                     fmt::format("the first value {} of the timer is outside its range [{}, {}]",
                                 brief(first), brief(low), brief(high)));
  return std::clamp(first, low, high);
}

}  // namespace

Scenario make_scenario(const model::Design::Campaign& campaign, const System& system) {
  Scenario scenario;
  scenario.horizon = horizon_of(campaign, system);
  scenario.starts = rules_of(campaign.starts, system);
  for (const auto& clock : system.clocks) {
    scenario.first.emplace_back();
    scenario.laws.emplace_back();
    if (!clock) continue;
    if (campaign.first) scenario.first.back() = first_of(*campaign.first, *clock, system);
    if (clock->low == clock->high) continue;
    scenario.laws.back() = make_laws(laws_of(scenario.laws.size() - 1, campaign.laws), clock->low,
                                     clock->high, system);
  }
  return scenario;
}

std::uint64_t stream_key(std::uint64_t seed, Purpose purpose, std::size_t index) {
  const auto low = [](std::uint64_t x) { return static_cast<std::uint32_t>(x & 0xFFFFFFFFU); };
  const auto words = philox4x32({static_cast<std::uint32_t>(purpose), low(index), 0, 0},
                                {low(seed), low(seed >> 32U)});
  return (static_cast<std::uint64_t>(words[0]) << 32U) | words[1];
}

RandomStream draw_stream(std::uint64_t seed, std::uint64_t run, Purpose purpose,
                         std::size_t index) {
  return {stream_key(seed, purpose, index), run};
}

VectorXd draw_start(const System& system, const Scenario& scenario, std::uint64_t seed,
                    std::uint64_t run) {
  VectorXd values = VectorXd::Zero(system.whole);
  const GivenRun* given = scenario.given_for(run);
  // Starts may use the first values of noise.
  NoiseDraws noise(system, scenario, seed, run);
  for (std::size_t k = 0; k < system.noise.size(); ++k) noise.draw(k, values);
  for (std::size_t i = 0; i < scenario.starts.size(); ++i) {
    if (!scenario.starts[i]) continue;
    const StartRule& rule = *scenario.starts[i];
    const Dynamics::Variable& variable = system.dynamics.variables[i];
    numbers::Matrix value;
    if (given != nullptr && i < given->starts.size() && given->starts[i]) {
      value = *given->starts[i];
    } else if (rule.kind == StartKind::expression) {
      value = SystemFunction(rule.program, system)(values);
    } else if (rule.kind == StartKind::list) {
      value = rule.values[run % rule.values.size()];
    } else {
      RandomStream random = draw_stream(seed, run, Purpose::start, i);
      value = rule.kind == StartKind::box
                  ? box_value(rule, variable.structure == model::Structure::symmetric, random)
                  : draw_around(rule, random);
    }
    check_value(variable, rule.place, value);
    values.segment(system.layout.slots[i].offset, value.size()) = value.reshaped();
  }
  // d = a - b takes the place of b.
  for (const auto& [b, a] : scenario.differences) {
    const Slot& slot = system.layout.slots[b];
    auto d = values.segment(slot.offset, slot.shape.size());
    d = values.segment(system.layout.slots[a].offset, slot.shape.size()) - d;
  }
  return values;
}

EventClocks::EventClocks(const System& system, const Scenario& scenario, std::uint64_t seed,
                         std::uint64_t run)
    : system_(&system), scenario_(&scenario), run_(run) {
  for (std::size_t e = 0; e < system.dynamics.events.size(); ++e) {
    clocks_.push_back({never, never, 0, 0, 0, draw_stream(seed, run, Purpose::length, e),
                       draw_stream(seed, run, Purpose::lost, e)});
    Clock& clock = clocks_.back();
    clock.due = clock.first = clock.length = first_due(e, clock, seed);
  }
}

/// In this order: given times of `at`, the given run, the campaign, one length, a draw in the
/// range.
double EventClocks::first_due(std::size_t event, Clock& clock, std::uint64_t seed) const {
  const std::vector<double>& times = system_->times[event];
  if (!times.empty()) return times.front();
  const auto& rule = system_->clocks[event];
  if (!rule) return never;
  const GivenRun* given = scenario_->given_for(run_);
  if (given != nullptr && event < given->first.size() && given->first[event])
    return std::clamp(*given->first[event], rule->first->first, rule->first->second);
  if (event < scenario_->first.size() && scenario_->first[event]) return *scenario_->first[event];
  if (!rule->first) return drawn_length(event, clock, 0);
  const auto [low, high] = *rule->first;
  if (low == high) return low;
  return low + (high - low) * draw_stream(seed, run_, Purpose::first, event).uniform();
}

/// The next length in [low, high]: given, by the law of this run, or uniform.
double EventClocks::drawn_length(std::size_t event, Clock& clock, double t) const {
  const System::Clock& rule = *system_->clocks[event];
  const std::uint64_t number = clock.lengths++;
  if (rule.low == rule.high) return rule.low;
  const GivenRun* given = scenario_->given_for(run_);
  if (given != nullptr && event < given->lengths.size() && !given->lengths[event].empty()) {
    const std::vector<double>& lengths = given->lengths[event];
    return std::clamp(lengths[number % lengths.size()], rule.low, rule.high);
  }
  const std::vector<Law>& laws = scenario_->laws[event];
  if (laws.empty()) return rule.low + (rule.high - rule.low) * clock.random.uniform();
  return laws[run_ % laws.size()].reset_value(number, t, clock.random);
}

double EventClocks::next() const {
  double earliest = never;
  for (const Clock& clock : clocks_) earliest = std::min(earliest, clock.due);
  return earliest;
}

void EventClocks::advance(std::size_t event, double t) {
  Clock& clock = clocks_[event];
  ++clock.occurrences;
  const auto& rule = system_->clocks[event];
  const std::vector<double>& times = system_->times[event];
  if (!rule) {
    clock.due = clock.occurrences < times.size() ? times[clock.occurrences] : never;
  } else if (rule->low == rule->high) {
    clock.length = rule->low;
    // first + k T by one product: a sum of k lengths would collect rounding.
    clock.due = clock.first + static_cast<double>(clock.occurrences) * rule->low;
  } else {
    clock.length = drawn_length(event, clock, t);
    clock.due += clock.length;
  }
}

/// Bernoulli of probability `lost`, except that after `in_a_row` losses in a row none follows.
bool EventClocks::loses(std::size_t event) {
  const Dynamics::Event& one = system_->dynamics.events[event];
  Clock& clock = clocks_[event];
  const std::uint64_t number = clock.jumps++;
  const GivenRun* given = scenario_->given_for(run_);
  const bool is_given =
      given != nullptr && event < given->losses.size() && !given->losses[event].empty();
  const bool drawn = is_given ? given->losses[event][number % given->losses[event].size()] != 0
                              : clock.lost.uniform_at(number) < one.lost;
  const bool may = !one.lost_in_a_row || clock.lost_in_a_row < *one.lost_in_a_row;
  clock.lost_in_a_row = drawn && may ? clock.lost_in_a_row + 1 : 0;
  return drawn && may;
}

NoiseDraws::NoiseDraws(const System& system, const Scenario& scenario, std::uint64_t seed,
                       std::uint64_t run)
    : system_(&system),
      given_(scenario.given_for(run)),
      run_(run),
      number_(system.noise.size(), 0),
      times_(system.noise.size(), 0) {
  for (std::size_t i = 0; i < system.noise.size(); ++i)
    random_.push_back(draw_stream(seed, run, Purpose::noise, i));
}

/// Given values first; of vertices element run/stride modulo their number; else c + M z, c .* exp(M
/// z), or uniform.
VectorXd NoiseDraws::next_value(std::size_t noise) {
  const Dynamics::Noise& one = system_->dynamics.noise[noise];
  const std::vector<numbers::Matrix>& rule = system_->noise[noise].values;
  if (given_ != nullptr && noise < given_->noise.size() && !given_->noise[noise].empty()) {
    const std::vector<numbers::Matrix>& values = given_->noise[noise];
    return values[number_[noise]++ % values.size()].reshaped();
  }
  if (one.kind == Dynamics::NoiseKind::vertices || one.kind == Dynamics::NoiseKind::corners)
    return rule[run_ / system_->noise[noise].stride % rule.size()].reshaped();
  RandomStream& random = random_[noise];
  if (one.has_center())
    return around(rule[0], rule[1], draw_normal(one.shape.size(), random),
                  one.kind == Dynamics::NoiseKind::lognormal)
        .reshaped();
  VectorXd value(one.shape.size());
  for (Eigen::Index k = 0; k < value.size(); ++k)
    value(k) = rule[0](k) + (rule[1](k) - rule[0](k)) * random.uniform();
  return value;
}

void NoiseDraws::draw(std::size_t noise, VectorXd& values) {
  const VectorXd value = next_value(noise);
  const auto& variables = system_->dynamics.variables;
  for (std::size_t i = 0; i < variables.size(); ++i)
    if (variables[i].kind == Dynamics::VariableKind::noise && variables[i].of == noise)
      values.segment(system_->layout.slots[i].offset, value.size()) = value;
}

double NoiseDraws::next() const {
  double earliest = never;
  for (std::size_t i = 0; i < times_.size(); ++i)
    if (system_->noise[i].every)
      earliest = std::min(earliest, static_cast<double>(times_[i] + 1) * *system_->noise[i].every);
  return earliest;
}

bool NoiseDraws::draw_due(double t, VectorXd& values) {
  bool any = false;
  for (std::size_t i = 0; i < times_.size(); ++i) {
    if (!system_->noise[i].every) continue;
    const double due = static_cast<double>(times_[i] + 1) * *system_->noise[i].every;
    if (due > t + kOneInstant * std::abs(t)) continue;
    ++times_[i];
    draw(i, values);
    any = true;
  }
  return any;
}

}  // namespace gainsmith::hybrid
