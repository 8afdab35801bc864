#include "hybrid/state_layout.h"

#include <algorithm>
#include <utility>

namespace gainsmith::hybrid {

std::optional<std::size_t> StateLayout::slot(const std::string& name) const {
  const auto found = std::ranges::find(slots, name, &Slot::name);
  if (found == slots.end()) return std::nullopt;
  return static_cast<std::size_t>(found - slots.begin());
}

/// Offsets are sums of the sizes of the variables before.
StateLayout layout_of(const model::Dynamics& dynamics) {
  StateLayout layout;
  for (const model::Dynamics::Variable& variable : dynamics.variables) {
    layout.slots.push_back({variable.name, variable.shape, layout.size});
    layout.size += variable.shape.size();
  }
  return layout;
}

namespace {

/// The timer is behind the states.
std::optional<Eigen::Index> place_of(const std::string& name, const StateLayout& layout) {
  if (name == layout.timer) return layout.size;
  const auto found = layout.slot(name);
  return found ? std::optional(layout.slots[*found].offset) : std::nullopt;
}

}  // namespace

numbers::StackedFunctions stacked(std::vector<const expr::Program*> programs,
                                  const StateLayout& layout, const numbers::Values& constants) {
  const auto place = [&](const std::string& name) { return place_of(name, layout); };
  return {std::move(programs), place, constants, layout.size};
}

PointFunction::PointFunction(const expr::Program& program, const StateLayout& layout,
                             const numbers::Values& constants)
    : function_(stacked({&program}, layout, constants)) {}

}  // namespace gainsmith::hybrid
