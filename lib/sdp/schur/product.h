// Matrix products in double at the rate of the machine's vector unit.
#pragma once

#include "sdp/core/view.h"

namespace gainsmith::sdp {

/// C = A B or C -= A B (kernels.h: multiply), by tiles of C that stay in registers (Goto, van de
/// Geijn 2008). For matrices of 10 to 1000 rows, where general libraries spend their time on
/// examining the shape.
void multiply_doubles(const View<const double>& a, const View<const double>& b,
                      const View<double>& c, Update update);

/// C = A B' or C -= A B'
void multiply_outer_doubles(const View<const double>& a, const View<const double>& b,
                            const View<double>& c, Update update);

}  // namespace gainsmith::sdp
