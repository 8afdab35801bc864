// What a gain file says, for programs: values, and the bodies of the functions.
//
//   basis (orth, null)    the file's matrix, and what follows from it in the data
//   unknown function Y    the file's text over the file's coefficients Y_0, Y_1, ...
//   gain L                the file's matrix
//   gain F(tau)           of a constant      the file's matrix
//                         of a polynomial    F_0 + F_1*tau + ..., the file's coefficients
//                         otherwise          the file's formula
//
// So a simulation evaluates the decimals and the texts of the file, not those of a program that
// would generate others today.
#pragma once

#include "model/function.h"
#include "model/gains.h"
#include "model/instance.h"

namespace gainsmith::model {

struct Stated {
  numbers::Values values;  ///< data, parameters, gains, unknowns, coefficients: all that are known
  Bodies bodies;           ///< of unknown functions and of gains that are functions
  /// How many coefficients each unknown function has in the file; its own number without a point.
  std::vector<UnknownMatrix> unknowns;

  /// The value of a program; none when it uses something that has no value, such as a gain of a
  /// problem without solution.
  std::optional<numbers::Matrix> value(const expr::Program& program) const;
};

}  // namespace gainsmith::model
