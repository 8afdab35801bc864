// What the variables of `forall` run over, with numbers.
#pragma once

#include <string>
#include <vector>

#include "model/design.h"
#include "numbers/real.h"

namespace gainsmith::forall {

/// One variable of `forall`. An interval has its ends, a set its elements, a polytope its vertices.
struct Variable {
  std::string name;
  model::Over over = model::Over::interval;
  double low = 0;
  double high = 0;
  std::vector<numbers::Matrix> elements;
  std::vector<std::string> labels;  ///< "k = 2", "A = A2": one an element
  expr::Shape shape;
  Place place;

  bool is_interval() const { return over == model::Over::interval; }
};

using Domain = std::vector<Variable>;

/// InputError, at the place of the `forall`, for an empty interval and for ends or elements that
/// are not finite or have different shapes.
Domain domain_of(const model::Design::Inequality& inequality, const numbers::Values& values);

/// A variable whose functions are examined without a range; none for an empty name.
Domain free_variable(const std::string& name);

/// Values for some of the variables, and how a message names them.
struct Point {
  numbers::Values values;
  std::string label;  ///< "k = 2, tau = 0.7"; empty without variables
};

/// The point with one more variable.
Point extended(const Point& point, const std::string& name, const numbers::Matrix& value,
               const std::string& label);
Point extended(const Point& point, const std::string& name, double value);

/// Whether the point has every value of the other.
bool has_values_of(const Point& point, const Point& other);

/// All combinations of the elements of the variables over that kind of domain; one empty point when
/// there is no such variable.
std::vector<Point> combinations(const Domain& domain, model::Over over);

/// All combinations of the elements of sets and the vertices of polytopes.
std::vector<Point> finite_points(const Domain& domain);

/// The interval variables, in order.
std::vector<const Variable*> intervals(const Domain& domain);

}  // namespace gainsmith::forall
