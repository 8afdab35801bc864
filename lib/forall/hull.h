// "For all tau" by vertices: the box of the ranges of the functions that occur in an inequality.
//
// With phi_1(t), ..., phi_N(t) the functions of an interval in B(t) = B_0 + sum_k phi_k(t) B_k, B
// is affine in phi, and phi lies in the box of its ranges. So B > 0 at the 2^N vertices of the box
// is enough for all t. With one function, whose range is exact but for t^k e^(at) cos(bt) with k >
// 0, the vertices are points of the interval, and it is necessary too.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "forall/monomials.h"

namespace gainsmith::forall {

/// Values for all monomials of a table.
struct Vertex {
  std::vector<double> values;
  std::string label;  ///< "tau = 0.7", "cos(2*tau) = 1, sin(2*tau) = 0", "A = A2"
  /// The values of the variables there, when it is a point of the domain: up to rounding where an
  /// interval's function has its extremum inside.
  std::optional<Point> point;
};

struct Hull {
  std::vector<Vertex> vertices;
  /// Whether each vertex is a point of the domain, so that nothing is lost: every interval variable
  /// enters through one function at most, whose range is known exactly.
  bool exact = true;
};

/// The size that the terms of each monomial of a form reach at most: coefficient times monomial.
using Sizes = std::map<int, double>;

/// The largest |phi| of a monomial on the domain, or more.
double largest_value(const Monomial& monomial, const MonomialTable& monomials);

/// The monomials whose terms are rounding noise: below 1e-13 of the largest term on the whole
/// domain. `coefficients`: the largest |coefficient| of each.
std::set<int> noise(const Sizes& coefficients, const MonomialTable& monomials);

/// The vertices for the monomials that occur in a form without noise. Each interval that enters
/// through several functions is cut into `slices` equal parts with a box each. InputError at
/// `place` for more than 2^12 vertices and for functions that are too large for double.
Hull hull_of(const std::set<int>& standing, const MonomialTable& monomials, int slices,
             const Place& place);

}  // namespace gainsmith::forall
