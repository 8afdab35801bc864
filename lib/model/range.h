// Ranges of scalars, as read and as bound.
#pragma once

#include <string>

#include "expr/text/ast.h"
#include "model/formula.h"

namespace gainsmith::model {

/// A name with the ends of its range.
struct ScalarRange {
  std::string name;
  expr::Expression low;
  expr::Expression high;
  Place place;
};

/// A scalar and the range in which it is searched for.
struct Range {
  std::string name;
  Formula low;
  Formula high;
  Place place;
};

}  // namespace gainsmith::model
