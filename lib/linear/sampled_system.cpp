#include "linear/sampled_system.h"

#include <algorithm>
#include <string>
#include <utility>

#include "hybrid/affine.h"
#include "numbers/types/degree.h"

namespace gainsmith::linear {

namespace {

using model::Dynamics;
using VariableKind = Dynamics::VariableKind;

/// One event `every` that always happens.
bool is_one_clock(const Dynamics& dynamics) {
  if (dynamics.events.size() != 1) return false;
  const Dynamics::Event& event = dynamics.events.front();
  return event.kind == Dynamics::EventKind::every && !event.only_if && event.lost == 0;
}

bool is_plain(const Dynamics::Component& component) {
  return !component.frozen && component.flow_sets.empty();
}

bool is_plain(const Dynamics::Variable& variable) {
  const bool state =
      variable.kind == VariableKind::state && variable.structure != model::Structure::symmetric;
  return state || variable.kind == VariableKind::left;
}

bool is_plain(const Dynamics::Reaction& reaction) {
  if (reaction.passes.size() != 1) return false;
  const Dynamics::Pass& pass = reaction.passes.front();
  return !pass.repeats && !pass.until;
}

bool is_sampled(const hybrid::System& system) {
  const Dynamics& dynamics = system.dynamics;
  const auto all = [](const auto& list) {
    return std::all_of(list.begin(), list.end(), [](const auto& one) { return is_plain(one); });
  };
  return is_one_clock(dynamics) && dynamics.noise.empty() && dynamics.measured.empty() &&
         system.switches.empty() && all(dynamics.components) && all(dynamics.variables) &&
         all(dynamics.reactions);
}

/// Operations that have no evaluation in 100 digits.
bool is_without_wide_value(expr::Op op) {
  using enum expr::Op;
  return is_without_bounds(op) ||
         is_one_of(op, {pseudo_inverse, range_basis, kernel_basis, determinant});
}

/// With constant matrices: rates that read the timer are refused.
bool is_affine_flow(const std::vector<MapEntry>& map, const hybrid::StateLayout& layout) {
  const auto moves = [&](const std::string& name) { return layout.moves(name); };
  return std::none_of(map.begin(), map.end(), [&](const MapEntry& entry) {
    return hybrid::first_not_affine(entry.program, moves) != nullptr ||
           entry.program.uses(layout.timer);
  });
}

void add_variables(SampledSystem& system) {
  const auto& variables = system.dynamics->dynamics.variables;
  system.layout.timer = system.dynamics->dynamics.events.front().name + ".left";
  for (std::size_t k = 0; k < variables.size(); ++k) {
    if (variables[k].kind == VariableKind::left) {
      system.layout.timer = variables[k].name;
      continue;
    }
    hybrid::Slot slot = system.dynamics->layout.slots[k];
    slot.offset = system.layout.size;
    system.layout.size += slot.shape.size();
    system.layout.slots.push_back(std::move(slot));
    system.variable.push_back(k);
  }
}

}  // namespace

bool has_wide_value(const expr::Program& program, const hybrid::StateLayout& layout) {
  const auto degrees =
      numbers::degrees(program, [&](const std::string& name) { return layout.moves(name); });
  for (std::size_t k = 0; k < program.code.size(); ++k)
    if (degrees[k] > 0 && is_without_wide_value(program.code[k].op)) return false;
  return true;
}

std::unique_ptr<const SampledSystem> make_sampled_system(const hybrid::System& dynamics) {
  if (!is_sampled(dynamics)) return nullptr;
  auto system = std::make_unique<SampledSystem>();
  system->dynamics = &dynamics;
  add_variables(*system);
  const auto slot_of = [&](std::size_t variable) {
    const auto& all = system->variable;
    return static_cast<std::size_t>(std::find(all.begin(), all.end(), variable) - all.begin());
  };
  for (const Dynamics::Assignment& assignment : dynamics.dynamics.flow)
    system->flow.push_back({slot_of(assignment.variable), assignment.value.program});
  for (const Dynamics::Reaction& reaction : dynamics.dynamics.reactions)
    for (const Dynamics::Assignment& assignment : reaction.passes.front().map)
      system->jump.push_back({slot_of(assignment.variable), assignment.value.program});
  for (const std::vector<MapEntry>* map : {&system->flow, &system->jump})
    for (const MapEntry& entry : *map)
      if (!has_wide_value(entry.program, system->layout)) return nullptr;
  return is_affine_flow(system->flow, system->layout) ? std::move(system) : nullptr;
}

}  // namespace gainsmith::linear
