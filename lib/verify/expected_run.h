// Figures that are expected of the first run of dynamics with events.
//
// A figure f is known as f +- error. It is different when |f - wanted| - allowed > error. It is as
// expected when |f - wanted| - allowed <= -error, but for the rounding of decimals. Otherwise it is
// undecided.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "model/gains.h"
#include "model/instance.h"

namespace gainsmith::verify {

struct RunDifferences {
  std::vector<std::string> different;  ///< place: figure: expected ..., found ...
  std::vector<std::string> undecided;  ///< those whose errors do not decide
  std::size_t figures = 0;             ///< that were expected
};

/// What is expected of the first run (number 0) and is not found there.
RunDifferences run_differences(const model::Instance& instance, const model::Gains& gains);

}  // namespace gainsmith::verify
