// Programs as statements on numbers, in C, MATLAB and Python: the scalar graph of what they compute
// (numbers/graph/scalar_graph.h), printed. What several results need is computed once.
#pragma once

#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "export/identifiers.h"
#include "expr/program/program.h"
#include "numbers/types/real.h"

namespace gainsmith::exports {

/// How numbers and functions are written.
struct Dialect {
  Language language = Language::c;
  bool single = false;  ///< C: float instead of double
  std::string prefix;   ///< C: of the functions that represent operations, "motor_"
};

/// What the elements of an input are called, column by column.
using ElementNames = std::map<std::string, std::vector<std::string>, std::less<>>;

/// The code of several programs, which share their statements. A result is a formula, not always a
/// variable.
struct Code {
  std::vector<std::string> lines;  ///< statements, without indentation
  std::vector<std::vector<std::string>>
      results;                    ///< of each program the elements, column by column
  std::set<std::string> helpers;  ///< functions of helper_text() that they use
  bool library = false;           ///< C: they use functions of <math.h>
};

/// A program holds an operation on matrices that has no formula on numbers, such as svd.
struct NoCode : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Programs without calls. Inputs that have names are read, the others are numbers: `values` has
/// them.
Code scalar_code(const std::vector<expr::Program>& programs, const ElementNames& names,
                 const numbers::Values& values, const Dialect& dialect);

/// The functions that the code of a dialect uses, as text.
std::string helper_text(const std::set<std::string>& helpers, const Dialect& dialect);

/// A number as the dialect reads it back: "2.0", "0.1f", "2".
std::string number_text(double value, const Dialect& dialect);

/// "double" or "float".
std::string type_of(const Dialect& dialect);

}  // namespace gainsmith::exports
