// What a gain file says, for expressions: names and values.
//
//   unknown function Y    Y(tau) is the file's text over the file's coefficients Y_0, Y_1, ...
//   gain L                the file's matrix
//   gain F(tau)           of a constant      F_0, the file's matrix
//                         of a polynomial    F_0 + F_1*tau + ..., the file's coefficients
//                         otherwise          the file's formula
//
// So a simulation evaluates the decimals and the texts of the file, not those of a program that
// would generate others today.
#pragma once

#include "numbers/real.h"
#include "expr/scope.h"
#include "model/gains.h"
#include "model/instance.h"

namespace gainsmith::model {

/// The instance with its unknown functions defined as the gain file defines them. InputError when
/// the file defines what is no unknown function, or lacks its coefficients.
Instance with_functions(Instance instance, const Gains& gains);

struct Stated {
  expr::Scope scope;    ///< Instance::simulation_scope, with what the file says of functions
  numbers::Values values;  ///< data, parameters, gains, unknowns, coefficients: all that have a value
};

/// InputError for a matrix of another shape or not finite, and as with_functions().
Stated state(const Instance& instance, const Gains& gains);

}  // namespace gainsmith::model
