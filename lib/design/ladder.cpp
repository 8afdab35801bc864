#include "design/ladder.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <utility>

namespace gainsmith::design {

/// When each rung is due, and what it asks.
struct Rungs {
  static constexpr double kSafety = 4;     ///< of a back-off, times what is short
  static constexpr double kTighter = 0.1;  ///< times the bound on gains
  static constexpr double kNear = 0.01;  ///< of the bound; a gain far below it is not limited by it

  static bool always(const Climb&) { return true; }

  static bool margin_is_open(const Climb& climb) {
    const Attempt& own = climb.own();
    return own.question.goal == lmi::Goal::feasibility &&
           (own.is_infeasible() || (own.is_optimal() && !own.point));
  }

  static bool bounds_may_decide(const Climb& climb) {
    return infeasible(climb).is_infeasible() && !climb.bounds_.list.empty();
  }

  static bool is_short(const Climb& climb) { return shortfall(climb.own()) > 0; }

  static bool is_near_bounds(const Climb& climb) {
    const Attempt& point = *climb.point();
    if (!climb.posed_.lmi.has_objective || !is_kept(point)) return false;
    const auto bounds = lmi::reached_bounds(climb.bounds_, point.x);
    return std::any_of(bounds.begin(), bounds.end(), [](const model::GainBound& bound) {
      return !bound.active && bound.reached > kNear * bound.bound;
    });
  }

  static Question own(const Climb& climb) {
    return {lmi::goal_of(climb.posed_.lmi, climb.bounds_), climb.bounds_};
  }
  static Question margin(const Climb& climb) { return {lmi::Goal::certificate, climb.bounds_}; }
  static Question free(const Climb& climb) { return {infeasible(climb).question.goal, {}}; }
  static Question backed_off(const Climb& climb) {
    return {climb.own().question.goal, climb.bounds_, kSafety * shortfall(climb.own())};
  }
  static Question tighter(const Climb& climb) {
    return {climb.own().question.goal,
            lmi::gain_bounds(climb.posed_.inequalities, kTighter * climb.bounds_.beta), 0, false};
  }

  /// The attempt with bounds that would be infeasible.
  static const Attempt& infeasible(const Climb& climb) {
    const Attempt* margin = climb.find(Rung::margin);
    return margin != nullptr ? *margin : climb.own();
  }
};

namespace {

struct Row {
  Rung rung;
  bool from_point;
  bool (*is_due)(const Climb&);
  Question (*asks)(const Climb&);
};

constexpr std::array<Row, 5> kLadder = {{
    {Rung::own, false, Rungs::always, Rungs::own},
    {Rung::margin, false, Rungs::margin_is_open, Rungs::margin},
    {Rung::free, false, Rungs::bounds_may_decide, Rungs::free},
    {Rung::backed_off, true, Rungs::is_short, Rungs::backed_off},
    {Rung::tighter, true, Rungs::is_near_bounds, Rungs::tighter},
}};

}  // namespace

Climb::Climb(const Posed& posed, lmi::GainBounds bounds, Solve solve)
    : posed_(posed), bounds_(std::move(bounds)), solve_(std::move(solve)) {}

void Climb::to_answer() { climb(false); }

void Climb::from_point() {
  if (point() != nullptr) climb(true);
}

void Climb::climb(bool from_point) {
  using Clock = std::chrono::steady_clock;
  for (const Row& row : kLadder) {
    if (row.from_point != from_point || find(row.rung) != nullptr || !row.is_due(*this)) continue;
    const auto start = Clock::now();
    tried_.emplace(row.rung, attempt(posed_, row.asks(*this), solve_));
    seconds_ += std::chrono::duration<double>(Clock::now() - start).count();
  }
}

const Attempt* Climb::find(Rung rung) const {
  const auto found = tried_.find(rung);
  return found == tried_.end() ? nullptr : &found->second;
}

const Attempt* Climb::point() const {
  const Attempt* backed_off = find(Rung::backed_off);
  if (backed_off != nullptr && backed_off->point) return backed_off;
  return own().point ? &own() : nullptr;
}

const Attempt* Climb::certificate(bool& within_bounds) const {
  const Attempt* free = find(Rung::free);
  within_bounds = free != nullptr && !free->is_infeasible();
  if (free != nullptr && free->is_infeasible()) return free;
  const Attempt& bounded = Rungs::infeasible(*this);
  // A certificate of a search for the largest margin may rest on the limits on x.
  const bool limited = bounded.question.goal == lmi::Goal::feasibility;
  return bounded.is_infeasible() && !limited ? &bounded : nullptr;
}

}  // namespace gainsmith::design
