// Whether a datum has the structure that its method declares.
#pragma once

#include "numbers/real.h"
#include "model/method.h"
#include "model/problem.h"

namespace gainsmith::model {

/// Checks a datum that must be symmetric or diagonal and makes one that is symmetric to rounding
/// (1e-12 of its size) exactly so. InputError at the element where it is not.
void enforce_structure(const Declaration& datum, const Value& value, numbers::Matrix& matrix);

}  // namespace gainsmith::model
