#include "hybrid/system.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/number.h"

namespace gainsmith::hybrid {

namespace {

/// The entries of the flow or of the jump. InputError when one uses what has no value.
std::vector<MapEntry> link_map(const std::vector<model::Design::MapEntry>& entries,
                               const System& system) {
  std::vector<MapEntry> map;
  for (const model::Design::MapEntry& entry : entries) {
    expr::Program program = system.link(entry.value);
    const auto missing = system.missing(program);
    if (!missing.empty())
      throw InputError(entry.place, "there is no value for " + missing.front() + ", which '" +
                                        system.layout.slots[entry.state].name +
                                        "' needs: the gain file has none");
    map.push_back({entry.state, std::move(program)});
  }
  return map;
}

/// The values of the entries at (x, tau = 0); the other elements come from `rest`.
Eigen::VectorXd values_at(const System& system, const std::vector<MapEntry>& map,
                          const Eigen::VectorXd& x, Eigen::VectorXd rest) {
  for (const MapEntry& entry : map) {
    const Slot& slot = system.layout.slots[entry.slot];
    PointFunction value(entry.program, system.layout, system.constants);
    rest.segment(slot.offset, slot.shape.size()) = value(x, 0).reshaped();
  }
  return rest;
}

bool is_exact_flow(const std::vector<MapEntry>& map, const StateLayout& layout) {
  const auto moves = [&](const std::string& name) { return layout.moves(name); };
  return std::none_of(map.begin(), map.end(), [&](const MapEntry& entry) {
    return first_not_affine(entry.program, moves) != nullptr || entry.program.uses(layout.timer);
  });
}

void make_flow(const std::vector<model::Design::MapEntry>& entries, System& system) {
  system.flow_entries = link_map(entries, system);
  const auto& map = system.flow_entries;
  if (!is_exact_flow(map, system.layout)) return;
  const Eigen::Index n = system.layout.size;
  system.flow = sample_affine(
      [&](const Eigen::VectorXd& x) { return values_at(system, map, x, Eigen::VectorXd::Zero(n)); },
      n);
  double fastest = 0;
  for (const model::Design::MapEntry& entry : entries) {
    const Slot& slot = system.layout.slots[entry.state];
    const double size =
        system.flow->linear.middleRows(slot.offset, slot.shape.size()).cwiseAbs().sum();
    if (size > fastest) system.flow_place = entry.place;
    fastest = std::max(fastest, size);
  }
}

std::optional<AffineMap> make_affine_jump(const System& system) {
  const auto moves = [&](const std::string& name) {
    return name != system.layout.timer && system.layout.moves(name);
  };
  for (const MapEntry& entry : system.jump)
    if (first_not_affine(entry.program, moves) != nullptr) return std::nullopt;
  return sample_affine(
      [&](const Eigen::VectorXd& x) { return values_at(system, system.jump, x, x); },
      system.layout.size);
}

void read_timer(const model::Design::Timer& timer, System& system) {
  system.low = system.scalar(timer.low);
  system.high = system.scalar(timer.high);
  system.first_low = system.scalar(timer.first_low);
  system.first_high = system.scalar(timer.first_high);
  if (!(0 <= system.low && system.low <= system.high && 0 < system.high &&
        std::isfinite(system.high)))
    throw InputError(timer.place, fmt::format("the timer {} is reset to [{}, {}]: expected "
                                              "0 <= low <= high and high > 0",
                                              timer.name, brief(system.low), brief(system.high)));
  if (!(0 <= system.first_low && system.first_low <= system.first_high &&
        std::isfinite(system.first_high)))
    throw InputError(timer.place,
                     fmt::format("the first value of the timer {} is in [{}, {}]: expected "
                                 "0 <= low <= high",
                                 timer.name, brief(system.first_low), brief(system.first_high)));
}

}  // namespace

expr::Program System::link(const model::Formula& formula) const {
  return bodies.link(formula.program);
}

std::vector<std::string> System::missing(const expr::Program& program) const {
  std::vector<std::string> names;
  for (const expr::Input& input : program.inputs)
    if (!layout.moves(input.name) && !constants.contains(input.name)) names.push_back(input.name);
  return names;
}

numbers::Matrix System::value(const model::Formula& formula) const {
  const expr::Program program = link(formula);
  for (const expr::Input& input : program.inputs)
    if (!constants.contains(input.name))
      throw InputError(formula.place, "there is no value for " + input.name);
  return numbers::evaluate(program, constants);
}

System make_system(const model::Instance& instance, const model::Gains& gains) {
  const model::Design& design = *instance.design;
  if (!design.timer)
    throw InputError({design.method_file, 0, 0},
                     "the method has no timer, so there is nothing to simulate");
  System system;
  system.layout = make_layout(design.states, design.timer->name);
  model::Stated stated = model::state(instance, gains);
  system.constants = std::move(stated.values);
  system.bodies = std::move(stated.bodies);
  read_timer(*design.timer, system);
  make_flow(design.flow, system);
  system.jump = link_map(design.jump, system);
  system.affine_jump = make_affine_jump(system);
  return system;
}

}  // namespace gainsmith::hybrid
