// Internal to bind: data that are functions.
//
//   data: {low: n, f: {shape: n, of: {x: n}}}        the method
//   data: {low: [-1, -1], f(x): "[x(2); -x(1)]"}     the problem
//
// Such a datum is a definition, which inequalities, gains and dynamics call.
#pragma once

#include "bind/binding.h"

namespace gainsmith::bind {

/// Whether a datum is declared as a function. InputError where the problem gives a matrix for a
/// function, or a function for a matrix.
bool is_function(const model::Problem& problem, const model::Declaration& datum);

/// Makes the datum a definition, and learns dimensions from the shape of its values. The data
/// before it and the definitions of the problem may occur in it. InputError where the problem gives
/// none, another number of arguments, or another shape.
void add_function(Binding& binding, const model::Declaration& datum);

}  // namespace gainsmith::bind
