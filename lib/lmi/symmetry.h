// Why an inequality is not symmetric.
#pragma once

#include "lmi/affine.h"
#include "lmi/inequalities.h"

namespace gainsmith::lmi {

/// An unknown of shape n x n that keeps the form from being symmetric: with it, and perhaps others,
/// symmetric the form would be too, without it not. nullptr when there is none.
const model::Design::Unknown* needs_symmetric(const AffineForm& form, const Inequalities& of);

}  // namespace gainsmith::lmi
