// "For all tau" by vertices: the box of the ranges of the functions that stand in an inequality.
#pragma once

#include <string>
#include <vector>

#include "lmi/affine.h"
#include "lmi/monomials.h"

namespace gainsmith::lmi {

/// Values for all monomials of a table.
struct Vertex {
  std::vector<double> values;
  std::string label;  ///< "tau = 0.7", "cos(2*tau) = 1, sin(2*tau) = 0", "A = A2"
};

struct Hull {
  std::vector<Vertex> vertices;
  /// Whether each vertex is a point of the domain, so that nothing is lost: every interval variable
  /// enters through one function at most.
  bool exact = true;
};

/// Removes the monomials whose terms are rounding noise: below 1e-13 of the largest term on the
/// whole domain.
void remove_noise(AffineForm& form, const MonomialTable& monomials);

/// The vertices of a form without noise. Each interval that enters through several functions is cut
/// into `slices` equal parts with a box each. InputError at `place` for more than 2^12 vertices and
/// for functions that are too large for double.
Hull hull_of(const AffineForm& form, const MonomialTable& monomials, int slices,
             const Place& place);

/// The form with numbers for its monomials.
AffineForm at_vertex(const AffineForm& form, const std::vector<double>& values);

}  // namespace gainsmith::lmi
