// Which values rest on a search over a box: maximum(f, x in [a, b]) and minimum (operations.def,
// extremum). Such a value is f at the best point that was found, so it bounds the true one from one
// side; no verdict may rest on it.
#pragma once

#include <functional>
#include <string>

#include "expr/program/program.h"

namespace gainsmith::expr {

enum class Estimate {
  none,
  from_below,  ///< a maximum: the true one is at least the value
  from_above,  ///< a minimum
  mixed        ///< computed of such values
};

/// "estimate from below", "estimate from above", "from estimates"; empty for none.
std::string to_string(Estimate estimate);

/// What the value of a program is when those of its inputs are as `of_input` says.
Estimate estimate_of(const Program& program,
                     const std::function<Estimate(const std::string& input)>& of_input);

/// The first search that a program holds, in its jacobians too; null without one.
const Instruction* search_in(const Program& program);

}  // namespace gainsmith::expr
