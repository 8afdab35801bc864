// The parts of a step on which a value is smooth, and where it is largest there.
#pragma once

#include <vector>

#include "verify/run_values.h"

namespace gainsmith::verify {

struct SmoothPart {
  double from = 0;
  double to = 0;
  bool after_jump = false;   ///< the value jumps just before it
  bool before_jump = false;  ///< just after it
};

/// In order, at least one. `near`: takes the places at which it nearly branches.
std::vector<SmoothPart> smooth_parts(RunValue& value, const hybrid::DenseStep& step,
                                     std::vector<double>* near = nullptr);

}  // namespace gainsmith::verify
