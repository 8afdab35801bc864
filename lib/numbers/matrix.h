// Dense matrices of a scalar type, under the names that the number types give them.
#pragma once

#include "numerics/matrix.h"

namespace gainsmith::numbers {

using numerics::is_finite;
using numerics::Matrix;
using numerics::MatrixOf;
using numerics::times;
using numerics::Vector;

}  // namespace gainsmith::numbers
