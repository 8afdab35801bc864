// Where an inequality has no value: a pole, the root of a negative number.
#pragma once

#include <optional>
#include <string>

#include "expr/program/program.h"
#include "forall/domain.h"

namespace gainsmith::forall {

struct Fault {
  Place place;          ///< of the operation, in the text that it was written in
  std::string message;  ///< "division by zero"
  Point point;          ///< one at which it has no result
};

/// An operation of the inequality, or of what it differentiates, without a result at a point of the
/// intervals: a point of a grid, or one between two points at which a divisor, or a determinant,
/// has opposite signs. Of what `known` leaves open nothing is found. A search: none found does not
/// say that there is none.
std::optional<Fault> find_fault(const expr::Program& difference, const Domain& domain,
                                const numbers::Values& known);

}  // namespace gainsmith::forall
