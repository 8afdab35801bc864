#include "forall/plan.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gainsmith::forall {

namespace {

bool has_interval(const model::Design::Inequality& inequality) {
  const auto& domain = inequality.domain;
  return std::any_of(domain.begin(), domain.end(),
                     [](const auto& variable) { return variable.over == model::Over::interval; });
}

}  // namespace

bool Plan::leave_hulls(const model::Design& design) {
  if (design.synthesis.way != model::Way::automatic) return false;
  bool left = false;
  for (std::size_t k = 0; k < inequalities.size(); ++k) {
    if (inequalities[k].way != model::Way::hull || !has_interval(design.inequalities[k])) continue;
    inequalities[k] = {model::Way::exchange, true, {}};
    left = true;
  }
  return left;
}

bool Plan::uses_exchange() const {
  return std::any_of(inequalities.begin(), inequalities.end(),
                     [](const Imposed& imposed) { return !imposed.points.empty(); });
}

bool Plan::uses_vertex_gains() const {
  return std::any_of(inequalities.begin(), inequalities.end(), [](const Imposed& imposed) {
    return imposed.way == model::Way::vertex_gains;
  });
}

std::size_t Plan::points() const {
  std::size_t count = 0;
  for (const Imposed& imposed : inequalities) count += imposed.points.size();
  return count;
}

Plan make_plan(const model::Design& design) {
  Plan plan;
  plan.slices = design.synthesis.slices;
  const model::Way way = design.synthesis.way;
  for (const model::Design::Inequality& inequality : design.inequalities) {
    Imposed imposed{way, true, {}};
    if (way == model::Way::vertex_gains) {
      // Without unknown functions or intervals the test at vertices is an ordinary one.
      imposed.exact = !inequality.calls_functions() || !has_interval(inequality);
      if (imposed.exact) imposed.way = model::Way::automatic;
    }
    plan.inequalities.push_back(std::move(imposed));
  }
  return plan;
}

namespace {

/// With more, the corners alone are too many.
constexpr std::size_t kMostIntervals = 10;

}  // namespace

std::vector<Point> first_points(const Domain& domain) {
  const auto axes = intervals(domain);
  if (axes.size() > kMostIntervals)
    throw InputError(axes.front()->place, "an exchange over " + std::to_string(axes.size()) +
                                              " intervals; at most " +
                                              std::to_string(kMostIntervals));
  std::vector<Point> points;
  for (const Point& element : combinations(domain, model::Over::set)) {
    for (std::size_t corner = 0; corner < (std::size_t{1} << axes.size()); ++corner) {
      Point point = element;
      // An interval of one point has one corner.
      bool repeated = false;
      for (std::size_t v = 0; v < axes.size(); ++v) {
        const bool upper = ((corner >> v) & 1U) != 0;
        repeated |= upper && axes[v]->low == axes[v]->high;
        point = extended(point, axes[v]->name, upper ? axes[v]->high : axes[v]->low);
      }
      if (!repeated) points.push_back(std::move(point));
    }
    Point centre = element;
    bool single = true;
    for (const Variable* axis : axes) {
      centre = extended(centre, axis->name, axis->low + (axis->high - axis->low) / 2);
      single &= axis->low == axis->high;
    }
    if (!single) points.push_back(std::move(centre));
  }
  return points;
}

bool add_point(Imposed& imposed, const Domain& domain, const Point& point, double same) {
  const auto is_near = [&](const Point& other) {
    return std::all_of(domain.begin(), domain.end(), [&](const Variable& variable) {
      const auto mine = point.values.find(variable.name);
      const auto theirs = other.values.find(variable.name);
      if (mine == point.values.end() || theirs == other.values.end()) return true;
      if (!variable.is_interval()) return mine->second == theirs->second;
      return std::abs(mine->second(0, 0) - theirs->second(0, 0)) <=
             same * (variable.high - variable.low);
    });
  };
  if (std::any_of(imposed.points.begin(), imposed.points.end(), is_near)) return false;
  Point kept;
  kept.label = point.label;
  for (const Variable& variable : domain)
    if (variable.over != model::Over::polytope)
      kept.values[variable.name] = point.values.at(variable.name);
  imposed.points.push_back(std::move(kept));
  return true;
}

}  // namespace gainsmith::forall
