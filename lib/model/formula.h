// A bound expression and where it is written.
#pragma once

#include <string>

#include "base/error.h"
#include "expr/program/program.h"

namespace gainsmith::model {

struct Formula {
  expr::Program program;
  Place place;
  std::string text;  ///< as written
};

struct NamedFormula {
  std::string name;
  Formula value;
  Place place;
};

}  // namespace gainsmith::model
