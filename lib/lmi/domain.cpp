#include "lmi/domain.h"

#include <algorithm>

#include "base/number.h"
#include "expr/compile.h"

namespace gainsmith::lmi {

namespace {

using Over = model::Forall::Over;

Variable variable_of(const model::Instance& instance, const model::Forall& forall) {
  Variable result;
  result.name = forall.variable;
  result.over = forall.over;
  result.place = forall.place;
  const numbers::Values values = instance.known_values();
  if (forall.over == Over::interval) {
    result.low = model::scalar_value(forall.points[0], instance.scope, values);
    result.high = model::scalar_value(forall.points[1], instance.scope, values);
    if (!(result.low <= result.high))
      throw InputError(forall.place, "the interval [" + brief(result.low) + ", " +
                                         brief(result.high) + "] is empty");
    return result;
  }
  for (const expr::Expression& element : forall.points) {
    const expr::Program program = expr::compile(element, instance.scope);
    if (result.elements.empty()) result.shape = program.shape();
    if (program.shape() != result.shape)
      throw InputError(element.place(*element.root),
                       "the elements of " + forall.variable + " must have one shape; found " +
                           to_string(result.shape) + " and " + to_string(program.shape()));
    result.elements.push_back(numbers::evaluate(program, values));
    const numbers::Matrix& value = result.elements.back();
    result.labels.push_back(
        forall.variable + " = " +
        (value.size() == 1 ? brief(value(0, 0)) : element.quote(*element.root)));
  }
  return result;
}

}  // namespace

Domain domain_of(const model::Instance& instance, const model::Requirement& requirement) {
  Domain domain;
  for (const model::Forall& forall : requirement.forall)
    domain.push_back(variable_of(instance, forall));
  return domain;
}

Domain free_variable(const std::string& name) {
  if (name.empty()) return {};
  Variable variable;
  variable.name = name;
  return {variable};
}

expr::Scope scope_with(const model::Instance& instance, const Domain& domain) {
  expr::Scope scope = instance.design_scope();
  for (const Variable& variable : domain)
    scope.symbols[variable.name] = {variable.shape, std::nullopt};
  return scope;
}

Point extended(const Point& point, const std::string& name, const numbers::Matrix& value,
               const std::string& label) {
  Point result = point;
  result.values.insert_or_assign(name, value);
  result.label += (result.label.empty() ? "" : ", ") + label;
  return result;
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

}  // namespace gainsmith::lmi
