// What the runs of a design read, for the values of one gain file.
//
// Here functions are replaced by their bodies, in all texts and once: the programs call
// nothing. What they use is a variable of the dynamics or a constant, or has no value.
#pragma once

#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "base/double_double.h"
#include "model/design.h"
#include "model/dynamics.h"
#include "model/stated.h"

namespace gainsmith::model {

struct RunTexts {
  Place method;       ///< the file of the method
  Stated stated;      ///< the constants, and the bodies of functions
  Dynamics dynamics;  ///< with a variable for the integral of each flow cost of a claim
  Design::Campaign campaign;
  std::vector<Design::Claim> claims;
  /// Variables b that hold a difference a - b, with a: they start as b, then b is taken from a.
  std::vector<std::pair<std::size_t, std::size_t>> differences{};
  /// Some of `stated.values` in 31 digits, from the decimals of their texts; none: that is not known.
  std::function<numbers::ValuesOf<DoubleDouble>(const numbers::Values&)> in_31_digits{};
};

/// InputError for a design without dynamics, and for a derivative that is not known.
RunTexts run_texts(const Design& design, Stated stated);

/// The variable that is the cost of a claim so far. It rests along flows, and in jumps.
std::string cost_name(const std::string& claim);

}  // namespace gainsmith::model
