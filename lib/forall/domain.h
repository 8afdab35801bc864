// Inequalities for all values of their variables: B(x, t) > 0 for all t in a domain.
//
// B is a symmetric matrix, n x n, affine in the unknown scalars x; t are variables over intervals,
// finite sets or polytopes. A program has finitely many inequalities, so B is imposed
//   at the vertices of a hull   of the functions of t in B: sufficient, sometimes exact (hull.h,
//                               box.h, atoms.h, monomials.h; expm as such functions, residues.h)
//   by exchange                 at points of the domain, to which those are added where a solution
//                               fails: necessary at each step (plan.h, worst.h, centres.h)
// Whatever the method, a solution counts only where it is proved on the whole domain by bounds on
// second derivatives (proof.h). The hull is that of Tran, Bernard & Marconi, equation (42);
// exchange is the method of semi-infinite programming (Hettich & Kortanek 1993).
//
// In this file is what the variables run over, with numbers.
#pragma once

#include <string>
#include <vector>

#include "model/design.h"
#include "numbers/types/real.h"

namespace gainsmith::forall {

/// One variable of `forall`. An interval has its ends, a set its elements, a polytope its vertices.
struct Variable {
  std::string name;
  model::Over over = model::Over::interval;
  double low = 0;  ///< the ends of an interval, low <= high
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
/// The pointers are into `domain`, which must outlive them.
std::vector<const Variable*> intervals(const Domain& domain);

}  // namespace gainsmith::forall
