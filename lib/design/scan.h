// A problem solved at every point of a grid of scalars. Each point is an ordinary synthesis,
// independent of the others.
#pragma once

#include <functional>
#include <optional>
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

/// The rows of these points, none of which has an answer yet.
std::vector<ScanRow> rows_of(const std::vector<std::vector<double>>& points);

/// Answers the rows with these numbers; the same for any number of threads (0: one a core). After a
/// stop (base/stop.h) the remaining ones are not tried. Figures are those of the design. `answered`
/// is called after each, one at a time: meanwhile no row changes. InputError for unknown names.
void scan(const model::DesignPtr& design, const std::vector<std::string>& names,
          const std::vector<std::size_t>& which, unsigned threads, const sdp::Options& solver,
          std::vector<ScanRow>& rows, const std::function<void()>& answered = {});

/// InputError when every row is refused.
void require_a_point(const std::vector<ScanRow>& rows);

/// All rows, in the order of the points. InputError when every point is refused.
std::vector<ScanRow> scan(const model::DesignPtr& design, const std::vector<std::string>& names,
                          const std::vector<std::vector<double>>& points, unsigned threads,
                          const sdp::Options& solver);

}  // namespace gainsmith::design
