#include "simulate/event_watch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "simulate/crossings_on_step.h"

namespace gainsmith::simulate {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

/// The first time after t at which the side of an affine function differs: its root, moved on by
/// units in the last place.
double line_root(const std::function<double(double)>& g, bool strict, double t, double last) {
  const auto side = [&](double value) { return strict ? value > 0 : value >= 0; };
  const double first = g(t);
  const double end = g(last);
  if (side(first) == side(end) || first == end) return last;
  // The secant is exact for a line. Rounding may put it on the near side: steps of 1, 2, 4, ...
  // units follow.
  double root = std::clamp(t + (last - t) * (first / (first - end)), std::nextafter(t, last), last);
  double unit = std::max(std::abs(root), last - t) * std::numeric_limits<double>::epsilon();
  while (root < last && side(g(root)) == side(first)) {
    root = std::min(root + unit, last);
    unit *= 2;
  }
  return root;
}

/// What comes to 0 within one instant has done so at the last of its times, in the order of events.
std::vector<double> last_of_instants(const std::vector<double>& times) {
  std::vector<double> result;
  for (const double t : times) {
    if (!result.empty() && t - result.back() <= hybrid::kOneInstant * t)
      result.back() = t;
    else
      result.push_back(t);
  }
  return result;
}

/// Of a turning point beyond a root that of the root, where something may happen.
double time_of(const ode::TurningPoint& turn, const std::vector<ode::Root>& roots) {
  double t = turn.t;
  if (turn.reached)
    for (const ode::Root& root : roots)
      if (root.right <= turn.t) t = root.right;
  return t;
}

/// What the rounding of a time on the step makes of the function there.
double rounding_of_time(CrossingsOnStep& on_step, const StepValues& inside) {
  constexpr double last_places = 4 * std::numeric_limits<double>::epsilon();
  const double swing = on_step.value(0, inside.to()) - on_step.value(0, inside.from());
  return last_places * inside.to() * std::abs(swing) / (inside.to() - inside.from());
}

}  // namespace

EventWatch::EventWatch(const hybrid::System& system) : system_(&system) {
  const auto bound = [&](const std::optional<expr::Condition>& text) {
    return text ? std::optional<hybrid::EventCondition>(std::in_place, *text, system)
                : std::nullopt;
  };
  for (const model::Dynamics::Event& event : system.dynamics.events) {
    when.push_back(bound(event.condition));
    only_if.push_back(bound(event.only_if));
    crossing.emplace_back();
    if (event.crossing) crossing.back().emplace(event.crossing->program, system);
  }
  rounding_.assign(crossing.size(), 0);
  time_rounding_.assign(crossing.size(), 0);
  for (const model::Dynamics::Component& component : system.dynamics.components)
    for (const auto& flow_set : component.flow_sets)
      flow_sets.push_back(
          {hybrid::EventCondition(flow_set.where, system), flow_set.say, flow_set.place});
  for (const hybrid::Switch& one : system.switches) switches.emplace_back(one.difference, system);
}

void EventWatch::comparisons_of(const Role& role, const VectorXd& values, const Visit& visit) {
  hybrid::EventCondition& condition = *role.condition;
  if (condition.at_rest(values) != Truth::unknown) return;
  using Kind = expr::Condition::Kind;
  for (std::size_t k = 0; k < condition.comparisons().size(); ++k) {
    hybrid::EventCondition::Comparison& comparison = condition.comparisons()[k];
    if (comparison.function.rests()) continue;
    visit(comparison.function,
          {comparison.kind != Kind::nonnegative, comparison.kind != Kind::positive},
          {role.of, role.index, &condition, k});
  }
}

void EventWatch::active_functions(const VectorXd& values, const Visit& visit) {
  using Of = hybrid::NearTurn::Of;
  for (std::size_t e = 0; e < when.size(); ++e) {
    if (when[e]) comparisons_of({Of::when, e, &*when[e], 0}, values, visit);
    if (crossing[e] && !crossing[e]->rests())
      visit(*crossing[e], {true, true}, {Of::crossing, e, nullptr, 0});
  }
  for (std::size_t s = 0; s < flow_sets.size(); ++s)
    comparisons_of({Of::flow_set, s, &flow_sets[s].where, 0}, values, visit);
}

/// Whether it matters on which side of 0 the function is.
bool EventWatch::decides(const Role& role, const VectorXd& values) {
  return role.condition == nullptr ||
         role.condition->if_changed(values, role.comparison) != (*role.condition)(values);
}

bool EventWatch::is_noise(std::size_t event, const VectorXd& values) {
  return crossing[event]->is_noise(values) ||
         std::abs((*crossing[event])(values)(0)) <= rounding_[event];
}

/// The time of an instant rounds too, and e moves by its rate in that time.
bool EventWatch::may_be_noise(std::size_t event, const VectorXd& values) {
  return is_noise(event, values) ||
         std::abs((*crossing[event])(values)(0)) <= rounding_[event] + time_rounding_[event];
}

hybrid::EventFunction& EventWatch::function_of(const hybrid::NearTurn& turn) {
  if (turn.of == hybrid::NearTurn::Of::crossing) return *crossing[turn.index];
  hybrid::EventCondition& condition =
      turn.of == hybrid::NearTurn::Of::when ? *when[turn.index] : flow_sets[turn.index].where;
  return condition.comparisons()[turn.comparison].function;
}

std::vector<double> EventWatch::crossings(
    const StepValues& inside, const VectorXd& values, double near,
    const std::function<void(const hybrid::NearTurn&, bool)>& turn, double& left,
    std::optional<double>* hidden) {
  std::vector<double> result;
  std::vector<double> times;
  const numbers::Box box = inside.box();
  active_functions(values, [&](hybrid::EventFunction& function, Sides sides, const Role& role) {
    if (function.size() == 0) return;
    const std::vector<int>& apart = function.sides(box, near);
    if (apart.empty() ? seems_apart(function, inside, near)
                      : std::find(apart.begin(), apart.end(), 0) == apart.end())
      return;
    if (times.empty()) times = ode::first_points(inside.from(), inside.to());
    CrossingsOnStep on_step(function, inside, times);
    double before = 0;
    if (role.of == hybrid::NearTurn::Of::crossing) {
      before = std::exchange(rounding_[role.index], on_step.noise()(0));
      time_rounding_[role.index] = rounding_of_time(on_step, inside);
    }
    for (Index element = 0; element < function.size(); ++element) {
      if (!apart.empty() && apart[static_cast<std::size_t>(element)] != 0) continue;
      if (hidden != nullptr)
        if (const auto early = on_step.hidden_turn(element); early && early < hidden->value_or(1))
          *hidden = early;
      if (role.of == hybrid::NearTurn::Of::crossing)
        if (const auto leaves = on_step.leaves_zero(element, before)) result.push_back(*leaves);
      ode::Found found;
      for (const bool strict : {true, false}) {
        if (!(strict ? sides.above : sides.at_least)) continue;
        if (strict || !sides.above || found.meets_zero)
          found = on_step.roots(element, strict, near);
        for (const ode::Root& root : found.roots) {
          const double slope = on_step.hidden_slope(element, root.right);
          // Nothing has come to the side that it does not leave for; the other one it has reached
          // where rounding no longer hides it, also what else has left 0.
          if (slope * on_step.value(element, root.right) < 0) continue;
          const auto leaves =
              slope != 0 ? on_step.leaves_zero(element, before) : std::optional<double>();
          if (leaves) left = std::max(left, *leaves);
          result.push_back(leaves.value_or(root.right));
        }
        for (const ode::TurningPoint& turning : found.turning_points) {
          if (!decides(role, inside.at(turning.t))) continue;
          const std::string text = role.condition == nullptr
                                       ? system_->dynamics.events[role.index].name
                                       : role.condition->comparisons()[role.comparison].text;
          turn({role.of, role.index, role.comparison, element, time_of(turning, found.roots),
                turning.value, text},
               turning.reached);
        }
      }
    }
  });
  std::sort(result.begin(), result.end());
  return last_of_instants(result);
}

double EventWatch::next_line(const VectorField& field, double t, double last,
                             const VectorXd& values) {
  std::vector<double> roots = {last};
  VectorXd point = values;
  const auto search = [&](hybrid::EventFunction& function, Sides sides) {
    if (!function.is_line()) return;
    for (Index element = 0; element < function.size(); ++element)
      for (const bool strict : {true, false}) {
        if (!(strict ? sides.above : sides.at_least)) continue;
        const auto g = [&](double at) {
          point = values;
          if (at != t) field.fill(at, point);
          return function(point)(element);
        };
        roots.push_back(line_root(g, strict, t, last));
      }
  };
  active_functions(values, [&](hybrid::EventFunction& function, Sides sides, const Role&) {
    search(function, sides);
  });
  for (std::size_t k = 0; k < switches.size(); ++k) {
    const hybrid::Switch& one = system_->switches[k];
    if (!switches[k].rests())
      search(switches[k], {one.strict, one.kind != hybrid::Switch::Kind::where || !one.strict});
  }
  std::sort(roots.begin(), roots.end());
  return last_of_instants(roots).front();
}

}  // namespace gainsmith::simulate
