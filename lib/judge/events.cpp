#include "judge/events.h"

#include <cmath>

#include "judge/flow.h"

namespace gainsmith::judge {

namespace {

using EventKind = model::Dynamics::EventKind;
using V = model::Dynamics::VariableKind;

/// Of one event, in order.
std::vector<double> jump_times(const hybrid::Trajectory& trajectory, std::size_t event) {
  std::vector<double> times;
  for (const auto& part : trajectory.parts)
    if (const auto* jump = std::get_if<hybrid::JumpPoint>(&part);
        jump != nullptr && jump->event == event)
      times.push_back(jump->t);
  return times;
}

}  // namespace

EventCheck::EventCheck(Texts& texts, const hybrid::Trajectory& trajectory, Faults& faults)
    : texts_(texts),
      faults_(faults),
      horizon_(trajectory.horizon),
      memory_(texts.events.size()),
      inside_(texts, memory_, faults) {
  const Eigen::VectorXd rounding =
      rounding_at(texts, 0, trajectory.start, texts.by_variable(trajectory.start.cwiseAbs()));
  for (std::size_t e = 0; e < memory_.size(); ++e) {
    const EventKind kind = texts.dynamics.events[e].kind;
    if (kind == EventKind::every || kind == EventKind::at)
      memory_[e].clock.emplace(texts, e, jump_times(trajectory, e), trajectory.start, faults);
    if (has_crossing(e))
      forget_side(e, trajectory.start, rounding, crossing(e, trajectory.start) == 0);
  }
}

void EventCheck::remember_side(std::size_t event, const Eigen::VectorXd& x,
                               const Eigen::VectorXd& rounding) {
  const int now = side_of(*texts_.events[event].crossing, x, rounding);
  if (now == 0) return;
  memory_[event].side = now;
  memory_[event].at_zero = memory_[event].near_zero = false;
}

void EventCheck::forget_side(std::size_t event, const Eigen::VectorXd& x,
                             const Eigen::VectorXd& rounding, bool at_zero) {
  memory_[event].side = 0;
  memory_[event].at_zero = at_zero;
  memory_[event].near_zero = true;
  remember_side(event, x, rounding);
}

/// A jump of another event keeps the side that e had. Its own jump, or one that leads e to 0,
/// forgets it.
void EventCheck::side_after(std::size_t event, const hybrid::JumpPoint& jump,
                            const Eigen::VectorXd& rounding) {
  EventMemory& memory = memory_[event];
  const double before = crossing(event, jump.before);
  const double after = crossing(event, jump.after);
  const bool comes_to_zero = after == 0 && before != 0;
  Text& text = *texts_.events[event].crossing;
  const bool near = side_of(text, jump.after, rounding) == 0;
  if (after != before || event == jump.event) memory.spent = false;
  if (event != jump.event && !comes_to_zero) {
    memory.near_zero = memory.near_zero || (near && after != before);
    return;
  }
  forget_side(event, jump.after, rounding, comes_to_zero);
  if (comes_to_zero || !near || side_of(text, jump.before, rounding) != 0) return;
  // It has crossed 0 and stays there, on the side to which it has.
  const model::Dynamics::EventKind kind = texts_.dynamics.events[event].kind;
  int to = before > 0 ? 1 : before < 0 ? -1 : 0;
  for (const int only : {-1, 1})
    if (!leaves_zero(kind, -only)) to = only;
  if (to == 0 || (after != before && to * after <= 0)) return;
  memory.side = to;
  memory.near_zero = false;
  memory.spent = true;
}

Truth EventCheck::without_if(std::size_t event, double t, const Eigen::VectorXd& x,
                             const Eigen::VectorXd& rounding) {
  EventTexts& texts = texts_.events[event];
  const EventMemory& memory = memory_[event];
  if (memory.clock) {
    // With an `if` it may have been spent just before.
    if (t >= memory.clock->next())
      return t > memory.clock->next() && texts.only_if ? Truth::unknown : Truth::yes;
    const double early = t == horizon_ ? hybrid::kAddedUp * horizon_ : 0;
    const bool near = same_time(t, memory.clock->next()) || memory.clock->next() - t <= early;
    return near ? Truth::unknown : Truth::no;
  }
  if (texts.condition) {
    if ((*texts.condition)(x)) return memory.spent ? Truth::no : Truth::yes;
    return texts.condition->truth(x, rounding) == Truth::no ? Truth::no : Truth::unknown;
  }
  const double value = crossing(event, x);
  const int now = value > 0 ? 1 : value < 0 ? -1 : 0;
  const int certain = side_of(*texts.crossing, x, rounding);
  const EventKind kind = texts_.dynamics.events[event].kind;
  // Within its rounding it may have crossed 0, or left it, or not yet.
  if (fires(kind, memory.side, now)) return certain == now ? Truth::yes : Truth::unknown;
  if (memory.near_zero && leaves_zero(kind, now))
    return memory.at_zero && certain == now ? Truth::yes : Truth::unknown;
  // Just before zero: the run may have stopped there by rounding.
  const bool may_stop = !memory.spent && certain == 0 && fires(kind, memory.side, -memory.side);
  return may_stop ? Truth::unknown : Truth::no;
}

Truth EventCheck::due(std::size_t event, double t, const Eigen::VectorXd& x,
                      const Eigen::VectorXd& rounding) {
  const Truth occurs = without_if(event, t, x, rounding);
  auto& only_if = texts_.events[event].only_if;
  if (occurs == Truth::no || !only_if) return occurs;
  if ((*only_if)(x)) return occurs;
  return only_if->truth(x, rounding) == Truth::no ? Truth::no : Truth::unknown;
}

void EventCheck::instant(std::size_t part, double t, const Eigen::VectorXd& x,
                         std::optional<std::size_t> event) {
  const Eigen::VectorXd rounding = rounding_at(texts_, t, x, texts_.by_variable(x.cwiseAbs()));
  for (std::size_t e = 0; e < memory_.size(); ++e) {
    const std::string& name = texts_.dynamics.events[e].name;
    const Truth is_due = due(e, t, x, rounding);
    if (e == event) {
      if (is_due == Truth::no) faults_.add(part, t, "jumps, but is not due: " + name);
      return;
    }
    if (is_due == Truth::yes && event)
      faults_.add(
          part, t,
          "is due before " + texts_.dynamics.events[*event].name + ", which jumps: " + name);
    else if (is_due == Truth::yes)
      faults_.add(part, t, "is due, but does not jump: " + name);
    EventMemory& memory = memory_[e];
    auto& only_if = texts_.events[e].only_if;
    const Truth occurs = only_if && !(*only_if)(x) ? without_if(e, t, x, rounding) : Truth::no;
    const bool is_spent = occurs == Truth::yes;
    if (is_spent && memory.clock) memory.clock->spent(t);
    if (auto& condition = texts_.events[e].condition)
      memory.spent = (*condition)(x) && (memory.spent || is_spent);
    if (has_crossing(e) && occurs != Truth::no)
      forget_side(e, x, rounding, false);
    else if (has_crossing(e) && is_due != Truth::unknown)
      remember_side(e, x, rounding);
    // Within its rounding it may have crossed 0 in the other direction.
    if (has_crossing(e) && memory.side * crossing(e, x) < 0) memory.near_zero = true;
  }
}

void EventCheck::jumped(std::size_t part, const hybrid::JumpPoint& jump) {
  const model::Dynamics::Event& event = texts_.dynamics.events[jump.event];
  EventMemory& memory = memory_[jump.event];
  ++jumps_;
  ++memory.count;
  memory.last = jump.t;
  memory.lost_in_a_row = jump.lost ? memory.lost_in_a_row + 1 : 0;
  if (jump.lost && !(event.lost > 0))
    faults_.add(part, jump.t, "is lost, but never may be: " + event.name);
  if (!jump.lost && event.lost >= 1 && !event.lost_in_a_row)
    faults_.add(part, jump.t, "is not lost, but always is: " + event.name);
  if (event.lost_in_a_row && memory.lost_in_a_row > *event.lost_in_a_row)
    faults_.add(part, jump.t, "is lost more often in a row than may be: " + event.name,
                memory.lost_in_a_row, *event.lost_in_a_row);
  if (memory.clock) memory.clock->jumped(part, jump.t, jump.after);
  const Eigen::VectorXd rounding =
      rounding_at(texts_, jump.t, jump.after, texts_.by_variable(jump.after.cwiseAbs()));
  for (std::size_t e = 0; e < memory_.size(); ++e)
    if (has_crossing(e)) side_after(e, jump, rounding);
  check_numbers(part, jump.t, jump.after);
}

void EventCheck::flow(std::size_t part, const hybrid::FlowPiece& piece) {
  for (EventMemory& memory : memory_)
    if (memory.clock) memory.clock->flow(part, piece.from(), piece.start);
  inside_(part, piece);
  check_numbers(part, piece.to(), piece.end);
}

void EventCheck::end(std::size_t part, double t) {
  for (EventMemory& memory : memory_)
    if (memory.clock) memory.clock->end(part, t);
}

void EventCheck::check_numbers(std::size_t part, double t, const Eigen::VectorXd& x) {
  const auto& variables = texts_.dynamics.variables;
  for (std::size_t v = 0; v < variables.size(); ++v) {
    double expected = 0;
    double allowed = 0;
    if (variables[v].kind == V::time) {
      expected = t;
      allowed = time_rounding(t, t);
    } else if (variables[v].kind == V::jumps) {
      expected = static_cast<double>(jumps_);
    } else if (variables[v].kind == V::count) {
      expected = static_cast<double>(memory_[variables[v].of].count);
    } else if (variables[v].kind == V::since) {
      expected = t - memory_[variables[v].of].last;
      allowed = time_rounding(t, t);
    } else {
      continue;
    }
    faults_.check(part, t, "has another value: " + variables[v].name,
                  std::abs(texts_.part(x, v)(0) - expected), allowed);
  }
  for (EventMemory& memory : memory_)
    if (memory.clock) memory.clock->check_left(part, t, x);
}

}  // namespace gainsmith::judge
