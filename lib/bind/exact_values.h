// What a gain file and its problem say, in 100 digits: the constants of proofs, and of runs with
// more digits than double.
#pragma once

#include <Eigen/Core>

#include "base/eigen_scalars.h"
#include "base/scalars.h"
#include "model/gains.h"
#include "model/instance.h"
#include "numbers/types/real.h"

namespace gainsmith::bind {

/// Every constant of the system from the decimals as written. A datum is evaluated from its text in
/// 100 digits. A number of the gain file, and one that replaced the problem's, is the shortest
/// decimal that reads as its double: what a person wrote. A basis (orth, null) is that of the gain
/// file. What a datum's text does not give to 1e-9 keeps its double.
numbers::ValuesOf<Decimal100> exact_values(const model::Instance& instance,
                                           const numbers::Values& constants,
                                           const model::Gains& gains);

/// The shortest decimal that reads as this double, in 100 digits.
Decimal100 shortest_decimal(double value);

}  // namespace gainsmith::bind
