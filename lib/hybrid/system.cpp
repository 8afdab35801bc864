#include "hybrid/system.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/number.h"
#include "hybrid/affine.h"
#include "hybrid/initial.h"
#include "hybrid/pulses.h"
#include "hybrid/tolerances.h"
#include "model/dynamics_programs.h"

namespace gainsmith::hybrid {

namespace {

using model::Dynamics;
using Kind = Dynamics::VariableKind;

/// Sees to it that the texts that a run evaluates use variables and constants only.
void check_texts(System& system) {
  model::for_each_run_program(
      system.dynamics, [&](const expr::Program& program, const Place& place) {
        for (const expr::Input& input : program.inputs)
          if (!system.slot(input.name) && !system.constants.contains(input.name))
            throw InputError(place, "there is no value for " + input.name);
      });
}

/// Offsets of all variables. All rest at first, except clocks.
void stack_variables(System& system) {
  system.layout = layout_of(system.dynamics);
  system.whole = system.size = system.layout.size;
  for (const Dynamics::Variable& variable : system.dynamics.variables) {
    const bool is_clock =
        variable.kind == Kind::time || variable.kind == Kind::since || variable.kind == Kind::left;
    system.moves.push_back(is_clock ? Moves::steady : Moves::rests);
  }
}

/// What has the rate 0 rests.
void leave_out_resting(System& system) {
  std::erase_if(system.dynamics.flow, [&](const Dynamics::Assignment& assignment) {
    const expr::Program& rate = assignment.value.program;
    if (!std::ranges::all_of(rate.inputs, [&](const expr::Input& input) {
          return system.constants.contains(input.name);
        }))
      return false;
    try {
      return numbers::evaluate(rate, system.constants).isZero(0);
    } catch (const expr::EvaluationError&) {
      return false;  // said where it is integrated
    }
  });
}

/// Replaces branches of flows by inputs H, and appends one slot for each H to the layout.
void fix_branches_of_flows(System& system) {
  for (const Dynamics::Assignment& assignment : system.dynamics.flow)
    system.moves[assignment.variable] = Moves::flows;
  const auto moves = [&](const std::string& name) { return system.is_moving(name); };
  for (Dynamics::Assignment& assignment : system.dynamics.flow) {
    expr::Program fixed = fix_branches(assignment.value.program, moves, system.switches);
    const auto is_branch = [&](const expr::Input& input) {
      return !assignment.value.program.uses(input.name);
    };
    const bool branches = std::any_of(fixed.inputs.begin(), fixed.inputs.end(), is_branch);
    system.free_flow.push_back(branches ? std::optional(std::move(assignment.value.program))
                                        : std::nullopt);
    assignment.value.program = std::move(fixed);
  }
  for (const Switch& one : system.switches) {
    system.layout.slots.push_back({one.input, one.difference.shape(), system.whole});
    system.whole += one.difference.shape().size();
    system.moves.push_back(Moves::rests);
  }
  system.layout.size = system.whole;
}

/// Tells states of steady rate from others.
void classify_flows(System& system) {
  std::vector<std::size_t> steady;
  for (const Dynamics::Assignment& assignment : system.dynamics.flow) {
    const auto& inputs = assignment.value.program.inputs;
    if (std::none_of(inputs.begin(), inputs.end(),
                     [&](const expr::Input& input) { return system.is_moving(input.name); }))
      steady.push_back(assignment.variable);
  }
  for (const std::size_t variable : steady) system.moves[variable] = Moves::steady;
  const auto moves = [&](const std::string& name) { return system.is_moving(name); };
  system.affine = std::all_of(
      system.dynamics.flow.begin(), system.dynamics.flow.end(),
      [&](const auto& one) { return first_not_affine(one.value.program, moves) == nullptr; });
  const auto is_clock = [&](const std::string& name) {
    const auto slot = system.slot(name);
    return slot && system.moves[*slot] == Moves::steady;
  };
  system.pulses = std::ranges::any_of(system.dynamics.flow, [&](const auto& one) {
    return has_pulses(one.value.program, is_clock);
  });
}

/// 0 <= low <= high, 0 < high < infinity; else InputError at the place of the text.
System::Clock make_clock(const Dynamics::Event& event, const System& system) {
  System::Clock clock;
  clock.low = system.scalar(*event.low);
  clock.high = event.high ? system.scalar(*event.high) : clock.low;
  if (!(0 <= clock.low && clock.low <= clock.high && 0 < clock.high && std::isfinite(clock.high)))
    throw InputError(event.low->place,
                     fmt::format("the event {} comes after a time in [{}, {}]: expected 0 <= low "
                                 "<= high and high > 0",
                                 event.name, brief(clock.low), brief(clock.high)));
  if (!event.first_low) return clock;
  const double low = system.scalar(*event.first_low);
  const double high = event.first_high ? system.scalar(*event.first_high) : low;
  if (!(0 <= low && low <= high && std::isfinite(high)))
    throw InputError(event.first_low->place,
                     fmt::format("the event {} comes first at a time in [{}, {}]: expected 0 <= "
                                 "low <= high",
                                 event.name, brief(low), brief(high)));
  clock.first = {low, high};
  return clock;
}

/// Given times and rows of a file, in rising order, each once.
std::vector<double> times_of(const Dynamics::Event& event, const System& system) {
  std::vector<double> times;
  for (const model::Formula& formula : event.times) {
    const numbers::Matrix values = system.value(formula);
    for (Eigen::Index k = 0; k < values.size(); ++k) {
      if (!(values(k) >= 0 && std::isfinite(values(k))))
        throw InputError(formula.place, "the event " + event.name + " is due at " +
                                            brief(values(k)) + ": expected a time >= 0");
      times.push_back(values(k));
    }
  }
  times.insert(times.end(), event.rows.begin(), event.rows.end());
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

void read_events(System& system) {
  for (const Dynamics::Event& event : system.dynamics.events) {
    const bool every = event.kind == Dynamics::EventKind::every;
    const bool at = event.kind == Dynamics::EventKind::at;
    system.clocks.push_back(every ? std::optional(make_clock(event, system)) : std::nullopt);
    system.times.push_back(at ? times_of(event, system) : std::vector<double>{});
  }
}

/// The corners of a box [low, high]: elements whose ends differ are low or high, the first turns
/// fastest.
std::vector<numbers::Matrix> corners_of(const numbers::Matrix& low, const numbers::Matrix& high,
                                        const Dynamics::Noise& noise) {
  std::vector<Eigen::Index> free;
  for (Eigen::Index k = 0; k < low.size(); ++k)
    if (low(k) != high(k)) free.push_back(k);
  constexpr std::size_t bits = std::numeric_limits<std::size_t>::digits;
  if (free.size() >= bits || std::size_t{1} << free.size() > std::size_t{kMost})
    throw InputError(noise.place, fmt::format("the box of {} has 2^{} corners; at most {} are "
                                              "taken, otherwise give a list of vertices",
                                              noise.name, free.size(), kMost));
  std::vector<numbers::Matrix> corners;
  for (std::size_t corner = 0; corner < std::size_t{1} << free.size(); ++corner) {
    corners.push_back(low);
    for (std::size_t k = 0; k < free.size(); ++k)
      if ((corner >> k & 1U) != 0) corners.back()(free[k]) = high(free[k]);
  }
  return corners;
}

System::NoiseValues noise_values(const Dynamics::Noise& noise, const System& system) {
  using NoiseKind = Dynamics::NoiseKind;
  System::NoiseValues made;
  for (const model::Formula& formula : noise.values) {
    numbers::Matrix value = system.value(formula);
    if (noise.has_center() && !made.values.empty())
      value = spread_map(value, noise.covariance, noise.shape.size(), noise.name, formula.place);
    else if (value.size() == 1)
      value = numbers::Matrix::Constant(noise.shape.rows, noise.shape.cols, value(0, 0));
    made.values.push_back(std::move(value));
  }
  const auto& values = made.values;
  const bool box = noise.kind == NoiseKind::uniform || noise.kind == NoiseKind::corners;
  if (box && (values.front().array() > values.back().array()).any())
    throw InputError(noise.place, "the range of " + noise.name + " has low > high");
  if (noise.kind == NoiseKind::corners)
    made.values = corners_of(values.front(), values.back(), noise);
  if (noise.every) made.every = system.scalar(*noise.every);
  if (made.every && !(*made.every > 0))
    throw InputError(noise.every->place, noise.name + " is drawn anew after " + brief(*made.every) +
                                             ": expected a positive time");
  return made;
}

/// Vertices of several noises run through all combinations: noise i has the stride product of the
/// numbers of vertices of those before it.
void read_noise(System& system) {
  constexpr std::uint64_t most = std::numeric_limits<std::uint64_t>::max();
  std::uint64_t stride = 1;
  for (const Dynamics::Noise& noise : system.dynamics.noise) {
    system.noise.push_back(noise_values(noise, system));
    System::NoiseValues& made = system.noise.back();
    if (noise.kind != Dynamics::NoiseKind::vertices && noise.kind != Dynamics::NoiseKind::corners)
      continue;
    made.stride = stride;
    if (made.values.size() > most / stride)
      throw InputError(noise.place, "there are more than 2^64 vertices together");
    stride *= made.values.size();
  }
}

/// What a run reads has to be in the files.
void check_measured(const System& system) {
  for (const Dynamics::Measured& measured : system.dynamics.measured) {
    const model::Series& series = *measured.series;
    const bool at_rows = measured.event && !system.dynamics.events[*measured.event].rows.empty();
    if (series.times.front() > 0 && !at_rows)
      throw InputError(measured.place,
                       fmt::format("{} has no value at t = 0, where a run begins: the "
                                   "first row of {} is at {}; `from` says where in "
                                   "the file a run begins",
                                   measured.name, series.file, brief(series.times.front())));
    if (!measured.event) continue;
    if (!series.silent.empty() && !at_rows)
      throw InputError(measured.place,
                       fmt::format("{} has no value in some rows of {}, at t = {} first: let the "
                                   "event {} take its times from the file, at: {{csv: ...}}, and "
                                   "it does not happen there",
                                   measured.name, series.file, brief(series.silent.front(), 17),
                                   system.dynamics.events[*measured.event].name));
    for (const double t : system.dynamics.events[*measured.event].rows)
      if (!std::binary_search(series.times.begin(), series.times.end(), t))
        throw InputError(measured.place,
                         fmt::format("{} has no row at t = {}, where the event {} is "
                                     "due: {}",
                                     measured.name, brief(t, 17),
                                     system.dynamics.events[*measured.event].name, series.file));
  }
}

/// The most passes of each map of a jump: 1, or `at_most` or `times`, or kMost without either.
void read_passes(System& system) {
  for (const Dynamics::Reaction& reaction : system.dynamics.reactions) {
    std::vector<std::int64_t>& most = system.most_passes.emplace_back();
    for (const Dynamics::Pass& pass : reaction.passes) {
      most.push_back(pass.repeats ? kMost : 1);
      if (!pass.repeats || !pass.at_most) continue;
      const double number = system.scalar(*pass.at_most);
      if (!(number >= 0 && number <= static_cast<double>(kMost) && number == std::floor(number)))
        throw InputError(pass.at_most->place,
                         "expected a whole number of passes, found " + brief(number, 17));
      most.back() = static_cast<std::int64_t>(number);
    }
  }
}

/// Whether a program has values that keep still while what it reads moves.
bool has_levels(const expr::Program& program) {
  return std::any_of(
      program.code.begin(), program.code.end(), [](const expr::Instruction& instruction) {
        return instruction.op == expr::Op::sign || instruction.op == expr::Op::floor ||
               instruction.op == expr::Op::where;
      });
}

/// What moves along a flow is equal to something at single instants, between the numbers.
void refuse_equations(const expr::Condition& condition, const System& system) {
  if (condition.kind == expr::Condition::Kind::none) return;
  for (const expr::Condition& part : condition.parts) refuse_equations(part, system);
  if (condition.kind != expr::Condition::Kind::zero || has_levels(condition.difference)) return;
  for (const expr::Input& input : condition.difference.inputs)
    if (system.is_moving(input.name))
      throw InputError(condition.place,
                       fmt::format("'{}' is met in passing, as {} moves along flows: use <= "
                                   "or >=, or an event of its own, 'crosses: ...'",
                                   condition.text, input.name));
}

}  // namespace

bool System::rests(Eigen::Index element) const {
  const auto after = std::ranges::upper_bound(layout.slots, element, {}, &Slot::offset);
  const auto slot = after - layout.slots.begin() - 1;
  return moves[static_cast<std::size_t>(slot)] == Moves::rests;
}

bool System::is_moving(const std::string& name) const {
  const auto found = slot(name);
  return found && moves[*found] != Moves::rests;
}

std::string System::element_name(Eigen::Index element) const {
  for (const Slot& slot : layout.slots) {
    const Eigen::Index within = element - slot.offset;
    if (within < 0 || within >= slot.shape.size()) continue;
    if (slot.shape.is_scalar()) return slot.name;
    const Eigen::Index row = within % slot.shape.rows + 1;
    if (slot.shape.cols == 1) return fmt::format("{}({})", slot.name, row);
    return fmt::format("{}({}, {})", slot.name, row, within / slot.shape.rows + 1);
  }
  return "?";
}

numbers::Matrix System::value(const model::Formula& formula) const {
  for (const expr::Input& input : formula.program.inputs)
    if (!constants.contains(input.name))
      throw InputError(formula.place, "there is no value for " + input.name);
  return numbers::evaluate(formula.program, constants);
}

System make_system(const model::Dynamics& dynamics, numbers::Values constants) {
  System system;
  system.dynamics = dynamics;
  system.constants = std::move(constants);
  stack_variables(system);
  check_texts(system);
  leave_out_resting(system);
  fix_branches_of_flows(system);
  // Order matters: branches are found among what flows, and rates are classified after their
  // branches are fixed.
  classify_flows(system);
  read_events(system);
  read_noise(system);
  read_passes(system);
  check_measured(system);
  for (const model::Dynamics::Event& event : system.dynamics.events)
    if (event.condition) refuse_equations(*event.condition, system);
  return system;
}

}  // namespace gainsmith::hybrid
