#include "verify/coordinate_states.h"

#include <algorithm>
#include <map>
#include <utility>

namespace gainsmith::verify {

using model::Dynamics;

namespace {

/// Of each coordinate the variable that holds it.
std::vector<std::size_t> add_variables(const linear::Coordinates& coordinates, const Place& place,
                                       Dynamics& dynamics) {
  std::vector<std::size_t> held;
  const std::size_t states = dynamics.variables.size();
  for (std::size_t i = 0; i < coordinates.list.size(); ++i) {
    const hybrid::Slot& slot = coordinates.layout.slots[i];
    const auto begin = dynamics.variables.begin();
    const auto end = begin + static_cast<std::ptrdiff_t>(states);
    const auto same =
        std::find_if(begin, end, [&](const auto& one) { return one.name == slot.name; });
    if (same != end) {
      held.push_back(static_cast<std::size_t>(same - begin));
      continue;
    }
    held.push_back(dynamics.variables.size());
    Dynamics::Variable variable;
    variable.name = slot.name;
    variable.shape = slot.shape;
    variable.start = model::Formula{coordinates.list[i].start, place, {}};
    variable.place = place;
    dynamics.variables.push_back(std::move(variable));
  }
  return held;
}

/// Whether its rate is exactly 0.
bool rests(const linear::Coordinates& coordinates, std::size_t i) {
  const hybrid::Slot& slot = coordinates.layout.slots[i];
  const Eigen::Index rows = slot.shape.size();
  return coordinates.linear.middleRows(slot.offset, rows).isZero(0) &&
         coordinates.constant.middleRows(slot.offset, rows).isZero(0);
}

}  // namespace

/// Flow and jumps become those of the coordinates; claims read their functions.
model::RunTexts with_coordinates(model::RunTexts texts, const linear::Coordinates& coordinates,
                                 const std::vector<claims::Claim>& claims) {
  Dynamics& dynamics = texts.dynamics;
  const Place place = dynamics.events.front().place;
  dynamics.signals.clear();
  const std::vector<std::size_t> held = add_variables(coordinates, place, dynamics);
  dynamics.flow.clear();
  std::map<std::size_t, Dynamics::Pass> passes;  // by component
  for (std::size_t i = 0; i < coordinates.list.size(); ++i) {
    const linear::Coordinate& coordinate = coordinates.list[i];
    if (coordinate.flow && !rests(coordinates, i))
      dynamics.flow.push_back({held[i], {*coordinate.flow, place, {}}, place});
    if (coordinate.jump)
      passes[dynamics.variables[held[i]].component].map.push_back(
          {held[i], {*coordinate.jump, place, {}}, place});
  }
  dynamics.reactions.clear();
  for (auto& [component, pass] : passes) {
    pass.place = place;
    dynamics.reactions.push_back({0, component, {std::move(pass)}, place});
  }
  auto function = coordinates.functions.begin();
  for (std::size_t c = 0; c < claims.size(); ++c) {
    if (!claims[c].stated()) continue;
    model::Design::Claim& claim = texts.claims[c];
    claim.value.program = *function++;
    for (auto* part : {&claim.flow_cost, &claim.jump_cost, &claim.factor, &claim.bound})
      if (*part) (*part)->program = *function++;
  }
  return texts;
}

}  // namespace gainsmith::verify
