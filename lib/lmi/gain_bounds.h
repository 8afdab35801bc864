// Bounds on gains, so that an infimum that is only approached with ever larger gains still gives gains
// that can be built.
//
// A gain formula that holds inv(S)*E (or E*inv(S)), S a symmetric unknown and E affine in the unknowns,
// is bounded in the norm that S defines, relative to the mean eigenvalue of S:
//   E' inv(S) E <= beta^2 (trace(S)/n) I    <=>    [ S , E/beta ; * , (trace(S)/n) I ] >= 0.
// It does not change when the unknowns are scaled together. A gain that is an unknown itself is bounded
// by its largest singular value: [ beta I , K ; * , beta I ] >= 0.
#pragma once

#include <string>
#include <vector>

#include "lmi/compile.h"
#include "model/gains.h"
#include "model/instance.h"

namespace gainsmith::lmi {

struct GainBoundBlock {
  std::string what;   ///< "inv(P2)*X"
  double bound = 0;   ///< beta
  int rows = 0;       ///< of S
  Block block;        ///< non-strict
};

/// One bound for each different product in the gain formulas.
std::vector<GainBoundBlock> gain_bounds(const model::Instance& instance, const Unknowns& unknowns,
                                        double beta);

/// How far each bound is used at x: sqrt(lambda_max(E' inv(S) E) / (trace(S)/n)), or the largest singular
/// value; `active` above 99 % of the bound.
std::vector<model::GainBound> reached_bounds(const std::vector<GainBoundBlock>& bounds,
                                             const std::vector<double>& x);

}  // namespace gainsmith::lmi
