// A problem solved at every point of a grid of scalars.
#pragma once

#include <string>
#include <vector>

#include "model/gains.h"
#include "model/instance.h"
#include "sdp/solver.h"

namespace gainsmith::design {

struct ScanRow {
  std::vector<double> at;   ///< one value for each name
  std::string refused;      ///< why the values do not fit the problem's assumptions; then no result
  bool interrupted = true;  ///< before it was decided
  model::Verdict verdict = model::Verdict::undecided;
  std::optional<double> objective;             ///< of gains, where the method has one
  std::vector<std::optional<double>> figures;  ///< one for each of the design; none without a value
};

/// The rows in the order of the points; the same for any number of threads (0: one a core). After
/// a stop (base/stop.h) the remaining points are not tried. Figures are those of the design.
/// InputError when every point is refused, and for unknown names.
std::vector<ScanRow> scan(const model::DesignPtr& design, const std::vector<std::string>& names,
                          const std::vector<std::vector<double>>& points, unsigned threads,
                          const sdp::Options& solver);

}  // namespace gainsmith::design
