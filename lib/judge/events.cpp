#include "judge/events.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "judge/flow.h"

namespace gainsmith::judge {

namespace {

using EventKind = model::Dynamics::EventKind;
using V = model::Dynamics::VariableKind;

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
    if (has_crossing(e)) forget_side(e, trajectory.start, rounding, is_zero(e, trajectory.start));
  }
}

void EventCheck::remember_side(std::size_t event, const Eigen::VectorXd& x,
                               const Eigen::VectorXd& rounding) {
  const int now = side_of(*texts_.events[event].crossing, x, rounding);
  if (now == 0) return;
  memory_[event].side = now;
  memory_[event].at_zero = false;
}

void EventCheck::forget_side(std::size_t event, const Eigen::VectorXd& x,
                             const Eigen::VectorXd& rounding, bool at_zero) {
  memory_[event].side = 0;
  memory_[event].at_zero = at_zero;
  remember_side(event, x, rounding);
}

Truth EventCheck::without_if(std::size_t event, double t, const Eigen::VectorXd& x,
                             const Eigen::VectorXd& rounding) {
  EventTexts& texts = texts_.events[event];
  const EventMemory& memory = memory_[event];
  if (memory.clock) {
    if (t >= memory.clock->next()) return Truth::yes;
    const double early = t == horizon_ ? hybrid::kAddedUp * horizon_ : 0;
    const bool near = same_time(t, memory.clock->next()) || memory.clock->next() - t <= early;
    return near ? Truth::unsure : Truth::no;
  }
  if (texts.condition) {
    if ((*texts.condition)(x)) return memory.spent ? Truth::no : Truth::yes;
    return texts.condition->truth(x, rounding) == Truth::no ? Truth::no : Truth::unsure;
  }
  const double value = (*texts.crossing)(x)(0, 0);
  const int now = value > 0 ? 1 : value < 0 ? -1 : 0;
  const int certain = side_of(*texts.crossing, x, rounding);
  const EventKind kind = texts_.dynamics.events[event].kind;
  if (fires(kind, memory.side, now)) return Truth::yes;
  if (memory.side == 0 && leaves_zero(kind, memory.at_zero ? now : certain))
    return memory.at_zero && certain == now ? Truth::yes : Truth::unsure;
  // Just before zero: the run may have stopped there by rounding.
  return certain == 0 && fires(kind, memory.side, -memory.side) ? Truth::unsure : Truth::no;
}

Truth EventCheck::due(std::size_t event, double t, const Eigen::VectorXd& x,
                      const Eigen::VectorXd& rounding) {
  const Truth occurs = without_if(event, t, x, rounding);
  auto& only_if = texts_.events[event].only_if;
  if (occurs == Truth::no || !only_if) return occurs;
  if ((*only_if)(x)) return occurs;
  return only_if->truth(x, rounding) == Truth::no ? Truth::no : Truth::unsure;
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
    const bool is_spent = is_due == Truth::no && without_if(e, t, x, rounding) == Truth::yes;
    if (is_spent && memory.clock) memory.clock->spent(t);
    if (auto& condition = texts_.events[e].condition)
      memory.spent = (*condition)(x) && (memory.spent || is_spent);
    if (has_crossing(e) && (is_due == Truth::no || is_due == Truth::yes))
      remember_side(e, x, rounding);
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
  for (std::size_t e = 0; e < memory_.size(); ++e) {
    if (!has_crossing(e)) continue;
    const bool comes_to_zero = is_zero(e, jump.after) && !is_zero(e, jump.before);
    if (e == jump.event || comes_to_zero) forget_side(e, jump.after, rounding, comes_to_zero);
  }
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
