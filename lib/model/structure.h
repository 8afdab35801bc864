// Whether a datum has the structure that its method declares.
#pragma once

#include "model/design.h"
#include "numbers/matrix.h"

namespace gainsmith::model {

/// Checks a datum that must be symmetric or diagonal and makes one that is symmetric to rounding
/// (1e-12 of its size) exactly so. InputError at the element where it is not.
void enforce_structure(const Design::Datum& datum, numbers::Matrix& matrix);

}  // namespace gainsmith::model
