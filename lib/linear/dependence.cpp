// What depends on what among coordinates: which of them the functions need, and which are clocks.
#include <Eigen/Core>
#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "linear/coordinates.h"

namespace gainsmith::linear {

namespace {

/// For each coordinate, whether a function depends on it.
/// The set closed under "a jump of a needed coordinate reads it" and "its column in a needed row of
/// the flow is not 0".
std::vector<bool> find_needed(const Coordinates& all) {
  const std::vector<hybrid::Slot>& slots = all.layout.slots;
  std::vector<bool> needed(slots.size(), false);
  std::vector<std::size_t> open;
  const auto need = [&](std::size_t at) {
    if (needed[at]) return;
    needed[at] = true;
    open.push_back(at);
  };
  const auto need_inputs = [&](const expr::Program& program) {
    for (const expr::Input& input : program.inputs)
      if (const auto at = all.layout.slot(input.name)) need(*at);
  };
  for (const expr::Program& function : all.functions) need_inputs(function);
  while (!open.empty()) {
    const std::size_t at = open.back();
    open.pop_back();
    if (all.list[at].jump) need_inputs(*all.list[at].jump);
    for (std::size_t other = 0; other < slots.size(); ++other)
      if (!all.linear
               .block(slots[at].offset, slots[other].offset, slots[at].shape.size(),
                      slots[other].shape.size())
               .isZero(0))
        need(other);
  }
  return needed;
}

}  // namespace

void keep_needed(Coordinates& coordinates) {
  const std::vector<bool> needed = find_needed(coordinates);
  Coordinates kept;
  kept.layout.timer = coordinates.layout.timer;
  std::vector<Eigen::Index> elements;
  for (std::size_t i = 0; i < needed.size(); ++i) {
    if (!needed[i]) continue;
    const hybrid::Slot& slot = coordinates.layout.slots[i];
    kept.layout.slots.push_back({slot.name, slot.shape, kept.layout.size});
    kept.layout.size += slot.shape.size();
    kept.list.push_back(std::move(coordinates.list[i]));
    for (Eigen::Index e = 0; e < slot.shape.size(); ++e) elements.push_back(slot.offset + e);
  }
  kept.linear = coordinates.linear(elements, elements);
  kept.constant = coordinates.constant(elements, Eigen::all);
  kept.constants = std::move(coordinates.constants);
  kept.functions = std::move(coordinates.functions);
  coordinates = std::move(kept);
}

/// The largest set of coordinates with rows of 0 in the flow whose jumps read that set alone: all
/// with such rows, less those that break the rule, until none does.
void mark_clocks(Coordinates& coordinates) {
  const std::vector<hybrid::Slot>& slots = coordinates.layout.slots;
  std::set<std::string> clocks;
  const auto has_rate = [&](std::size_t i) {
    return coordinates.linear.middleRows(slots[i].offset, slots[i].shape.size()).isZero(0);
  };
  for (std::size_t i = 0; i < slots.size(); ++i)
    if (has_rate(i)) clocks.insert(slots[i].name);
  const auto jumps_with_others = [&](std::size_t i) {
    const auto& jump = coordinates.list[i].jump;
    return jump && std::any_of(jump->inputs.begin(), jump->inputs.end(), [&](const auto& input) {
             return coordinates.layout.moves(input.name) && !clocks.contains(input.name);
           });
  };
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = 0; i < slots.size(); ++i)
      if (clocks.contains(slots[i].name) && jumps_with_others(i)) {
        clocks.erase(slots[i].name);
        changed = true;
      }
  }
  for (std::size_t i = 0; i < slots.size(); ++i)
    coordinates.list[i].clock = clocks.contains(slots[i].name);
}

}  // namespace gainsmith::linear
