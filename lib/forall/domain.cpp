#include "forall/domain.h"

#include <algorithm>

#include "base/number.h"
#include "model/instance.h"

namespace gainsmith::forall {

namespace {

using model::Over;

/// InputError for low > high, and where an end is not a number.
Variable variable_of(const model::Design::Variable& stated, const numbers::Values& values) {
  Variable result;
  result.name = stated.name;
  result.over = stated.over;
  result.shape = stated.shape;
  result.place = stated.place;
  if (stated.over == Over::reals) return result;
  if (stated.over == Over::interval) {
    result.low = scalar_value(stated.points[0], values);
    result.high = scalar_value(stated.points[1], values);
    if (!(result.low <= result.high))
      throw InputError(stated.place, "the interval [" + brief(result.low) + ", " +
                                         brief(result.high) + "] is empty");
    return result;
  }
  for (const model::Formula& element : stated.points) {
    result.elements.push_back(numbers::evaluate(element.program, values));
    const numbers::Matrix& value = result.elements.back();
    result.labels.push_back(stated.name + " = " +
                            (value.size() == 1 ? brief(value(0, 0)) : element.text));
  }
  return result;
}

}  // namespace

Domain domain_of(const model::Design::Inequality& inequality, const numbers::Values& values) {
  Domain domain;
  for (const model::Design::Variable& variable : inequality.domain)
    domain.push_back(variable_of(variable, values));
  return domain;
}

Domain free_variable(const std::string& name) {
  if (name.empty()) return {};
  Variable variable;
  variable.name = name;
  return {variable};
}

Point extended(const Point& point, const std::string& name, const numbers::Matrix& value,
               const std::string& label) {
  Point result = point;
  result.values.insert_or_assign(name, value);
  result.label += (result.label.empty() ? "" : ", ") + label;
  return result;
}

bool has_values_of(const Point& point, const Point& other) {
  return std::all_of(other.values.begin(), other.values.end(), [&](const auto& value) {
    return point.values.at(value.first) == value.second;
  });
}

Point extended(const Point& point, const std::string& name, double value) {
  return extended(point, name, numbers::Matrix::Constant(1, 1, value), name + " = " + brief(value));
}

std::vector<Point> combinations(const Domain& domain, Over over) {
  std::vector<Point> points = {{}};
  for (const Variable& variable : domain) {
    if (variable.over != over) continue;
    std::vector<Point> next;
    for (const Point& point : points)
      for (std::size_t k = 0; k < variable.elements.size(); ++k)
        next.push_back(extended(point, variable.name, variable.elements[k], variable.labels[k]));
    points = std::move(next);
  }
  return points;
}

std::vector<Point> finite_points(const Domain& domain) {
  Domain finite;
  for (Variable variable : domain) {
    if (variable.is_interval()) continue;
    variable.over = Over::set;
    finite.push_back(std::move(variable));
  }
  return combinations(finite, Over::set);
}

std::vector<const Variable*> intervals(const Domain& domain) {
  std::vector<const Variable*> result;
  for (const Variable& variable : domain)
    if (variable.is_interval()) result.push_back(&variable);
  return result;
}

}  // namespace gainsmith::forall
