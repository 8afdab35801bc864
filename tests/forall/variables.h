// Variables of `forall` and programs over them, without a problem around them.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "expr/binding/compile.h"
#include "expr/text/parser.h"
#include "forall/domain.h"
#include "forall/plan.h"
#include "numbers/types/real.h"

namespace gainsmith::forall::testing {

inline Variable interval(std::string name, double low, double high) {
  Variable variable;
  variable.name = std::move(name);
  variable.low = low;
  variable.high = high;
  return variable;
}

/// A set or a polytope with the labels "A = 1", "A = 2", ...
inline Variable elements(std::string name, model::Over over,
                         std::vector<numbers::Matrix> matrices) {
  Variable variable;
  variable.name = std::move(name);
  variable.over = over;
  variable.elements = std::move(matrices);
  variable.shape = {static_cast<int>(variable.elements.front().rows()),
                    static_cast<int>(variable.elements.front().cols())};
  for (std::size_t k = 1; k <= variable.elements.size(); ++k)
    variable.labels.push_back(variable.name + " = " + std::to_string(k));
  return variable;
}

inline Variable set(std::string name, std::vector<numbers::Matrix> matrices) {
  return elements(std::move(name), model::Over::set, std::move(matrices));
}

inline Variable polytope(std::string name, std::vector<numbers::Matrix> matrices) {
  return elements(std::move(name), model::Over::polytope, std::move(matrices));
}

inline numbers::Matrix number(double value) { return numbers::Matrix::Constant(1, 1, value); }

/// A text in the variables and in matrices that are known.
inline expr::Program program(const std::string& text, const Domain& domain,
                             const numbers::Values& known = {}) {
  expr::Scope scope;
  for (const Variable& variable : domain) scope.symbols[variable.name] = {variable.shape};
  for (const auto& [name, value] : known) scope.symbols[name] = {numbers::shape_of(value)};
  return expr::compile(expr::parse({text, "test"}), scope);
}

/// Points of the variable tau.
inline Imposed imposed_at(const std::vector<double>& times) {
  Imposed imposed;
  for (const double tau : times) imposed.points.push_back(extended({}, "tau", tau));
  return imposed;
}

inline std::vector<double> times_of(const std::vector<Point>& points) {
  std::vector<double> times;
  for (const Point& point : points) times.push_back(point.values.at("tau")(0, 0));
  return times;
}

}  // namespace gainsmith::forall::testing
