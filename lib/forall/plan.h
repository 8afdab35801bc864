// How each inequality is imposed for all values of its variables, and where: at the vertices of a
// hull, which is fixed, or at the points of an exchange, which grow from round to round.
#pragma once

#include <vector>

#include "forall/domain.h"

namespace gainsmith::forall {

struct Imposed {
  model::Way way = model::Way::automatic;  ///< lmi::compile() decides and writes hull or exchange
  bool exact = true;                       ///< whether nothing is lost: always but for boxes
  std::vector<Point> points;  ///< exchange: values of the variables over intervals and sets
};

struct Plan {
  int slices = 1;                     ///< hull
  std::vector<Imposed> inequalities;  ///< in the order of the method

  /// Inequalities whose hull was chosen because nothing is lost by it go over to an exchange. False
  /// when there is none, or the hull was asked for.
  bool leave_hulls(const model::Design& design);

  bool uses_exchange() const;
  bool uses_vertex_gains() const;
  std::size_t points() const;  ///< of all exchanges
};

/// As the problem asks for.
Plan make_plan(const model::Design& design);

/// The first points of an exchange: for all elements of the sets the corners and the centre of the
/// box of the intervals. InputError for more than ten intervals.
std::vector<Point> first_points(const Domain& domain);

/// Adds a point to an exchange. False when one is there already, up to `same` of each interval:
/// points that a search found draw together without end.
bool add_point(Imposed& imposed, const Domain& domain, const Point& point, double same = 1e-9);

}  // namespace gainsmith::forall
