// Gains in single precision, and problems whose gains hold there.
#pragma once

#include <optional>
#include <string>

#include "model/gains.h"
#include "model/instance.h"
#include "sdp/solver.h"

namespace gainsmith::design {

/// The gains in single precision, with their exact decimals; of gains that are formulas over
/// unknowns these unknowns. Where the method has a plant or an observer, matrices that nothing of
/// them reads stay as they are. InputError for one that has no finite value there.
model::Gains rounded_to_single(const model::Instance& instance, const model::Gains& gains);

/// A value of `synthesis` with which the problem has gains that hold at single precision.
struct SinglePrecisionRemedy {
  std::string name;  ///< "margin" or "gain_bound"
  double value = 0;
  std::optional<double> objective;  ///< of the problem with this value
};

/// Solves again with larger margins, where something is minimised, and then with smaller bounds on
/// the gains: the first for which every inequality is shown at the rounded gains. `gains`: of the
/// instance. None where none of them is enough, or where gains come from a search over scalars.
std::optional<SinglePrecisionRemedy> remedy_at_single(const model::Instance& instance,
                                                      const model::Gains& gains,
                                                      const sdp::Options& options);

}  // namespace gainsmith::design
