#include "hybrid/state_layout.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace gainsmith::hybrid {

bool StateLayout::moves(const std::string& name) const {
  return name == timer || std::any_of(slots.begin(), slots.end(),
                                      [&](const Slot& slot) { return slot.name == name; });
}

StateLayout make_layout(const std::vector<model::Design::State>& states, const std::string& timer) {
  StateLayout layout;
  layout.timer = timer;
  for (const model::Design::State& state : states) {
    layout.slots.push_back({state.name, state.shape, layout.size});
    layout.size += state.shape.size();
  }
  return layout;
}

namespace {

/// The timer is behind the states.
std::optional<Eigen::Index> place_of(const std::string& name, const StateLayout& layout) {
  if (name == layout.timer) return layout.size;
  const auto found = std::find_if(layout.slots.begin(), layout.slots.end(),
                                  [&](const Slot& slot) { return slot.name == name; });
  if (found == layout.slots.end()) return std::nullopt;
  return found->offset;
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
