// Instants of a lane: the sides of watched differences, events that are due, and the beginning of
// flows. A side is known where the difference exceeds its estimated error. What is not certain and
// decides something leaves the lane open, with the reason in Why.
#include "packs/lane_set.h"

#include <algorithm>

namespace gainsmith::packs {

/// The order at an instant: sides, branches of the flow, claims, signs of crossings, then what is
/// due.
bool LaneSet::settle(std::size_t l) {
  PackLane& lane = *lanes_[l];
  if (!find_sides(l)) return false;
  const std::optional<bool> changed = set_branches(l);
  if (!changed) return false;
  if (*changed) return true;  // to be evaluated again
  for (std::size_t c = 0; c < lane.claims.size(); ++c) {
    if (lane.fresh || lane.jumped)
      lane.claims[c].at(lane.t, reading(c, l, start_, coarse_start_), lane.jumped);
    if (lane.claims[c].open()) return open(Why::claim);
  }
  // All of them at the start, and those that are led to 0 up to rounding: an event that comes first
  // may lead others through 0.
  for (std::size_t e = 0; e < pack_.events.size(); ++e) {
    const auto& crossing = pack_.events[e].crossing;
    if (!crossing) continue;
    const std::size_t w = crossing->watch;
    const bool zero = lane.sides[w] == 0 ||
                      (!pack_.watches[w].moves &&
                       std::abs(start_.at(PackSystem::watch_values, w, l)) <= error_here(w, l));
    if (lane.fresh || lane.jumped == e || zero) lane.signs[e] = zero ? 0 : side_of(*crossing, lane);
  }
  lane.fresh = false;
  lane.jumped.reset();
  return go_on(l);
}

bool LaneSet::find_sides(std::size_t l) {
  PackLane& lane = *lanes_[l];
  for (std::size_t w = 0; w < pack_.watches.size(); ++w) {
    const double value = start_.at(PackSystem::watch_values, w, l);
    if (!pack_.watches[w].moves) {
      lane.sides[w] = sign_of(value);
      if (sign_of(coarse_start_.at(PackSystem::watch_values, w, l)) != lane.sides[w])
        return open(Why::sign);
      continue;
    }
    const double error = std::max(error_here(w, l), lane.zero[w]);
    const bool is_new = lane.fresh || (lane.jumped && lane.before[w] != 0);
    if (is_crossing_[w] && is_new && is_exact_zero(w, l)) {
      if (!leave_zero(w, l)) return false;
    } else if (std::abs(value) > error) {
      lane.sides[w] = sign_of(value);
    } else if (lane.fresh || !is_crossing_[w] || std::abs(value - lane.before[w]) > error) {
      // What has crossed 0 goes on; otherwise the next step tells where it goes.
      lane.sides[w] = 0;
    }
  }
  return true;
}

/// The sign of the rate where both runs agree on it.
std::int8_t LaneSet::leaving_side(std::size_t w, std::size_t l) const {
  const std::int8_t side = sign_of(start_.at(PackSystem::watch_rates, w, l));
  return side == sign_of(coarse_start_.at(PackSystem::watch_rates, w, l)) ? side : std::int8_t{0};
}

bool LaneSet::leave_zero(std::size_t w, std::size_t l) {
  PackLane& lane = *lanes_[l];
  lane.sides[w] = leaving_side(w, l);
  // To a condition it is 0 here.
  if (lane.sides[w] == 0 || in_condition_[w] != 0) return open(Why::sign);
  for (std::size_t e = 0; e < pack_.events.size(); ++e) {
    const auto& crossing = pack_.events[e].crossing;
    if (!crossing || crossing->watch != w) continue;
    lane.signs[e] = side_of(*crossing, lane);
    if (is_wanted(e, lane.signs[e])) return open(Why::sign);
  }
  return true;
}

std::optional<bool> LaneSet::set_branches(std::size_t l) {
  bool changed = false;
  for (std::size_t w = 0; w < pack_.watches.size(); ++w) {
    const Watch& watch = pack_.watches[w];
    if (watch.branches.empty()) continue;
    std::int8_t& side = lanes_[l]->sides[w];
    if (side == 0 && watch.moves && in_condition_[w] == 0 && !is_crossing_[w])
      side = sign_of(start_.at(PackSystem::watch_rates, w, l));
    if (side == 0 && watch.moves) {
      why_ = Why::sign;
      return std::nullopt;
    }
    for (const Watch::Branch& branch : watch.branches) {
      const int own = branch.factor * side;
      const double value = branch.sign ? own : own > 0 || (own == 0 && !branch.strict) ? 1 : -1;
      changed = changed || fine_.at(branch.element, l) != value;
      set(branch.element, l, value);
    }
  }
  return changed;
}

bool LaneSet::go_on(std::size_t l) {
  PackLane& lane = *lanes_[l];
  lane.undetermined = false;
  if (!find_due(l)) return false;
  if (lane.due) return begin_jump(l);
  if (lane.t >= horizon_) {
    finish(l);
    return true;
  }
  // A branch that changes here is to be set before the flow goes on.
  if (has_open_branch(lane)) {
    lane.phase = Phase::evaluate;
    return true;
  }
  return begin_flow(l);
}

/// Whether what of a condition is neither above nor below 0 is 0 in both runs.
bool LaneSet::has_exact_zeros(const WatchedCondition& condition, std::size_t l) const {
  const auto is_exact = [&](const Watched& watched) {
    return lanes_[l]->sides[watched.watch] != 0 || is_exact_zero(watched.watch, l);
  };
  return std::all_of(condition.elements.begin(), condition.elements.end(), is_exact) &&
         std::all_of(condition.parts.begin(), condition.parts.end(),
                     [&](const WatchedCondition& part) { return has_exact_zeros(part, l); });
}

/// Events are tried in their order. A crossing is due once its side has changed in its direction, a
/// condition while it holds and is not spent, a clock at its time. A lane is left open where a
/// later condition holds at the same root.
bool LaneSet::find_due(std::size_t l) {
  PackLane& lane = *lanes_[l];
  lane.due.reset();
  const double now = lane.t >= horizon_ ? lane.t + hybrid::kAddedUp * horizon_ : lane.t;
  for (std::size_t e = 0; e < pack_.events.size(); ++e) {
    const PackEvent& event = pack_.events[e];
    bool due = false;
    if (event.crossing) {
      const std::int8_t side = side_of(*event.crossing, lane);
      if (side == 0 || lane.signs[e] == 0) return open(Why::sign);
      // At a root: no crossing if anything else is due there.
      if (side != lane.signs[e] && lane.phase == Phase::step && !is_wanted(e, side)) continue;
      if (side != lane.signs[e]) {
        lane.crossed[e] = static_cast<char>(is_wanted(e, side));
        if (lane.crossed[e] != 0 && turns_back(event.crossing->watch, l)) return open(Why::order);
      }
      lane.signs[e] = side;
      due = lane.crossed[e] != 0;
    } else if (event.when) {
      Truth is = truth(*event.when, pack_.watches, lane.sides);
      if (is == Truth::unknown && lane.spent[e] == 0) {
        // It is what exact zeros make of it, if all that is not certain is one.
        is = truth(*event.when, pack_.watches, lane.sides, Zeros::exact);
        if (!has_exact_zeros(*event.when, l)) return open(Why::sign);
        lane.undetermined = lane.undetermined || is == Truth::no;
      }
      if (is == Truth::no) lane.spent[e] = 0;
      due = is == Truth::yes && lane.spent[e] == 0;
    } else {
      due = lane.clocks.is_due(e, now);
    }
    // An event before it may be due as well; of x > 1 and x >= 1 the second is, before the first.
    const auto is_due_too = [&](const PackEvent& other) {
      return &other > &event && other.when &&
             truth(*other.when, pack_.watches, lane.sides) == Truth::yes;
    };
    const bool at_root = event.when && lane.phase == Phase::step;
    if (due && (lane.undetermined || (at_root && std::ranges::any_of(pack_.events, is_due_too))))
      return open(Why::order);
    if (due) return lane.due = e, true;
  }
  for (std::size_t e = 0; e < pack_.events.size(); ++e)
    if (const auto& crossing = pack_.events[e].crossing) lane.signs[e] = side_of(*crossing, lane);
  return true;
}

/// Marks the watches that may decide something in this flow, and sets its stop: the horizon, the
/// next clock, the next draw of noise, or the time from which a claim is made.
bool LaneSet::begin_flow(std::size_t l) {
  PackLane& lane = *lanes_[l];
  // What rounding sets apart is one time.
  const auto is_same = [](double t, double later) { return later <= (1 + hybrid::kAddedUp) * t; };
  std::fill(lane.relevant.begin(), lane.relevant.end(), 0);
  std::fill(lane.zero.begin(), lane.zero.end(), 0);
  for (const PackEvent& event : pack_.events) {
    if (event.when && truth(*event.when, pack_.watches, lane.sides, Zeros::still) == Truth::unknown)
      mark(*event.when, lane.relevant);
    if (event.crossing) lane.relevant[event.crossing->watch] = 1;
  }
  for (const WatchedCondition& set : pack_.flow_sets) {
    const Truth is = truth(set, pack_.watches, lane.sides);
    if (is == Truth::no) return open(Why::range);
    lane.undetermined = lane.undetermined || is == Truth::unknown;
    if (truth(set, pack_.watches, lane.sides, Zeros::still) == Truth::unknown)
      mark(set, lane.relevant);
  }
  for (std::size_t w = 0; w < pack_.watches.size(); ++w)
    if (!pack_.watches[w].branches.empty()) lane.relevant[w] = 1;
  // What is exactly 0 goes to the side to which it moves.
  for (std::size_t w = 0; w < pack_.watches.size(); ++w)
    if (lane.relevant[w] != 0 && lane.sides[w] == 0 && pack_.watches[w].moves &&
        is_exact_zero(w, l))
      lane.sides[w] = leaving_side(w, l);
  const auto becomes_due = [&](std::size_t e) {
    const auto& when = pack_.events[e].when;
    return when && lane.spent[e] == 0 && truth(*when, pack_.watches, lane.sides) == Truth::yes;
  };
  for (std::size_t e = 0; e < pack_.events.size(); ++e)
    if (becomes_due(e)) return open(Why::sign);
  if (lane.moved) {
    move(l, coarse_, coarse_start_, -lane.coarse_shift);
    move(l, fine_, start_, -lane.fine_shift);
    lane.moved = false;
  }
  lane.stop = std::min({horizon_, lane.clocks.next(), lane.noise.next()});
  for (const PackClaim& claim : pack_.claims)
    if (claim.after > lane.t && !(lane.has_jumped && is_same(lane.t, claim.after)) &&
        !is_same(claim.after, lane.stop))
      lane.stop = std::min(lane.stop, claim.after);
  lane.flow_start = lane.t;
  lane.evaluations = lane.steps = 0;
  lane.has_jumped = false;
  lane.largest.setZero();
  lane.phase = Phase::step;
  forget_root(lane);
  return lane.stop > lane.t || open(Why::jumps);
}

/// x <- x + time f(x). At a root this is the first-order effect of the event's time on the state.
void LaneSet::move(std::size_t l, LaneValues& values, const LanePoint& seen, double time) {
  for (std::size_t k = 0; k < pack_.rows.size(); ++k)
    values.at(static_cast<std::size_t>(pack_.rows[k]), l) +=
        time * seen.at(PackSystem::rates, k, l);
}

bool LaneSet::still_inside(std::size_t l) {
  PackLane& lane = *lanes_[l];
  for (const WatchedCondition& set : pack_.flow_sets)
    if (truth(set, pack_.watches, lane.sides) != Truth::yes) return open(Why::range);
  if (!lane.undetermined) return true;
  lane.undetermined = false;
  for (std::size_t e = 0; e < pack_.events.size(); ++e)
    if (pack_.events[e].when && lane.spent[e] == 0 &&
        truth(*pack_.events[e].when, pack_.watches, lane.sides) != Truth::no)
      return open(Why::sign);
  return true;
}

/// Each run goes to its own root by one step of Newton's method, s = -v/v'. The coarser one takes
/// the rates of the finer one for its move, as its own are not evaluated at ends of steps.
bool LaneSet::arrive_at_root(std::size_t l, std::size_t target) {
  PackLane& lane = *lanes_[l];
  if (!find_due(l)) return false;
  const Watch& watch = pack_.watches[target];
  if (!lane.due && watch.branches.empty()) return true;
  // Each run is moved to its own root: then they differ by what that makes of the time of the
  // event, and what is left of the root is no sign of anything else that comes to 0 with it.
  const auto shift = [&](const LanePoint& seen) {
    return -seen.at(PackSystem::watch_values, target, l) /
           seen.at(PackSystem::watch_rates, target, l);
  };
  lane.coarse_shift = shift(coarse_start_);
  lane.fine_shift = shift(start_);
  if (!std::isfinite(lane.coarse_shift + lane.fine_shift)) return open(Why::sign);
  move(l, coarse_, start_, lane.coarse_shift);
  move(l, fine_, start_, lane.fine_shift);
  lane.moved = true;
  // The next flow may be about as long.
  if (lane.due)
    lane.wanted =
        std::min(lane.wanted, std::max(2 * (lane.t - lane.flow_start), hybrid::kHardly * horizon_));
  keep_before(l);
  lane.phase = Phase::evaluate;
  return !lane.due || begin_jump(l);
}

/// An accumulation of jumps (hybrid/zeno.h) ends the run with what its claims are so far.
bool LaneSet::begin_jump(std::size_t l) {
  PackLane& lane = *lanes_[l];
  if (ends_in_zeno_ && !lane.has_jumped && lane.t > lane.flow_start) {
    for (Eigen::Index k = 0; k < pack_.system->size; ++k)
      scratch_(k) = fine_.at(static_cast<std::size_t>(k), l);
    lane.zeno.push(lane.t, lane.t - lane.flow_start, *lane.due, scratch_, lane.largest);
    if (lane.zeno.accumulation()) {
      finish(l);
      return true;
    }
    if (lane.zeno.chatters()) return open(Why::jumps);
  }
  lane.phase = Phase::jump;
  lane.has_jumped = true;
  return true;
}

bool LaneSet::arrive_at_stop(std::size_t l) {
  PackLane& lane = *lanes_[l];
  keep_before(l);
  for (std::size_t k = 0; k < pack_.whole; ++k)
    scratch_(static_cast<Eigen::Index>(k)) = fine_.at(k, l);
  if (lane.noise.draw_due(lane.t, scratch_)) {
    for (std::size_t k = 0; k < pack_.system->noise.size(); ++k)
      if (pack_.system->noise[k].every) take_noise(k, l);
    lane.phase = Phase::evaluate;
    return true;
  }
  return go_on(l);
}

bool LaneSet::has_open_branch(const PackLane& lane) const {
  for (std::size_t w = 0; w < pack_.watches.size(); ++w)
    if (!pack_.watches[w].branches.empty() && lane.sides[w] == 0) return true;
  return false;
}

}  // namespace gainsmith::packs
