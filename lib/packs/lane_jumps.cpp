// Jumps of lanes: noise is drawn, `only if` is decided, then the maps are applied to both runs. The
// second run is moved in its last places before, so that what jumps amplify shows in the
// difference.
#include "packs/lane_set.h"

#include <algorithm>
#include <bit>

namespace gainsmith::packs {

using lanes::kLanes;
using lanes::LaneMachine;
using model::Dynamics;
using VariableKind = Dynamics::VariableKind;

void LaneSet::jump_all(std::uint32_t mask) {
  const std::size_t event = *lanes_[static_cast<std::size_t>(std::countr_zero(mask))]->due;
  std::uint32_t same = 0;
  each(mask, [&](std::size_t l) {
    if (lanes_[l]->due == event) same |= 1U << l;
  });
  each(same, [&](std::size_t l) { draw(event, l); });
  if (pack_.events[event].only_if) same = allowed(event, same);
  std::uint32_t lost = 0;
  if (lost_[event])
    each(same, [&](std::size_t l) {
      if (lanes_[l]->clocks.loses(event)) lost |= 1U << l;
    });
  if ((same & ~lost) != 0) jump(event, same & ~lost, jumps_[event]);
  if (lost != 0) jump(event, lost, *lost_[event]);
}

void LaneSet::draw(std::size_t event, std::size_t l) {
  const auto& noise = pack_.system->dynamics.noise;
  for (std::size_t k = 0; k < noise.size(); ++k) {
    if (noise[k].event != event) continue;
    lanes_[l]->noise.draw(k, scratch_);
    take_noise(k, l);
  }
}

void LaneSet::take_noise(std::size_t noise, std::size_t l) {
  const auto& variables = pack_.system->dynamics.variables;
  for (std::size_t i = 0; i < variables.size(); ++i) {
    if (variables[i].kind != VariableKind::noise || variables[i].of != noise) continue;
    const hybrid::Slot& slot = pack_.system->layout.slots[i];
    for (Eigen::Index k = slot.offset; k < slot.offset + slot.shape.size(); ++k)
      set(static_cast<std::size_t>(k), l, scratch_(k));
  }
}

/// Decided by the finer run and its error, from the values just before the maps. An event that may
/// not jump spends its occurrence.
std::uint32_t LaneSet::allowed(std::size_t event, std::uint32_t mask) {
  evaluate(point_, fine_, middle_, mask);
  evaluate(point_, coarse_, end_, mask);
  std::uint32_t goes = 0;
  each(mask, [&](std::size_t l) {
    Sides sides(pack_.watches.size(), 0);
    bool same = ((middle_.faults | end_.faults) >> l & 1U) == 0;
    for (std::size_t w = 0; w < sides.size(); ++w) {
      const double value = middle_.at(PackSystem::watch_values, w, l);
      const bool exact = !pack_.watches[w].moves;
      if (exact || std::abs(value) > error_of(w, l, middle_, end_)) sides[w] = sign_of(value);
      if (exact && sign_of(end_.at(PackSystem::watch_values, w, l)) != sides[w]) same = false;
    }
    const Truth is = truth(*pack_.events[event].only_if, pack_.watches, sides);
    if (!same || is == Truth::unknown) {
      why_ = Why::sign;
      return leave_open(l);
    }
    if (is == Truth::yes) {
      goes |= 1U << l;
      return;
    }
    PackLane& lane = *lanes_[l];
    spend(event, l);
    lane.spent[event] =
        pack_.system->dynamics.events[event].kind == Dynamics::EventKind::when ? 1 : 0;
    keep_before(l);
    lane.phase = Phase::evaluate;
  });
  return goes;
}

void LaneSet::spend(std::size_t event, std::size_t l) {
  PackLane& lane = *lanes_[l];
  lane.crossed[event] = 0;
  lane.spent[event] = 0;
  if (!pack_.system->has_clock(event)) return;
  lane.clocks.advance(event, lane.t);
  fill_clocks(l);
}

/// x+ = g(x) in both runs. A value without a result, a mode that is no whole number, or a state
/// beyond kLargestState leaves the lane open.
void LaneSet::jump(std::size_t event, std::uint32_t mask, LaneMachine& machine) {
  std::uint32_t bad = 0;
  for (LaneValues* values : {&fine_, &coarse_}) {
    std::copy_n(values->row(0), pack_.whole * kLanes, machine.input(0));
    if (values == &coarse_)
      move_elements(
          set_by_jumps_, mask, [&](std::size_t l) -> Moves& { return lanes_[l]->moves; },
          machine.input(0));
    machine.run(mask);
    bad |= machine.faults();
    const LaneMask jumping(mask);
    for (std::size_t k = 0; k < static_cast<std::size_t>(pack_.system->size); ++k)
      jumping.copy(machine.result(0, k), values->row(k));
    each(mask, [&](std::size_t l) {
      for (std::size_t k = 0; k < static_cast<std::size_t>(pack_.system->size); ++k)
        if (!(std::abs(values->at(k, l)) <= hybrid::kLargestState)) bad |= 1U << l;
      for (std::size_t k = 0; k < machine.size(1); ++k)
        if (machine.result(1, k)[l] != 0) bad |= 1U << l;
    });
  }
  each(mask, [&](std::size_t l) {
    if ((bad >> l & 1U) != 0) {
      why_ = Why::no_value;
      return leave_open(l);
    }
    PackLane& lane = *lanes_[l];
    for (const std::size_t element : since_[event]) set(element, l, 0);
    spend(event, l);
    keep_before(l);
    lane.happened[event] = 1;
    lane.jumped = event;
    lane.phase = Phase::evaluate;
  });
}

}  // namespace gainsmith::packs
