// Scans and bisections as pictures.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "design/bisect.h"
#include "design/scan.h"
#include "drawing/map.h"

namespace gainsmith::app {

/// What a scan tried.
struct ScanPicture {
  std::string title;
  std::vector<drawing::GridAxis> axes;  ///< one or two; the last runs fastest in the rows
  std::vector<std::string>
      quantities;  ///< of each row the objective, where there is one, and the figures
  bool has_objective = false;
};

/// One scalar: each quantity over it, with gaps where there is none, and the verdicts below. Two: a map
/// of each quantity, or of the verdicts where there is none.
std::string scan_figure(const ScanPicture& picture, const std::vector<design::ScanRow>& rows);

/// The values in the order in which they were tried with their verdicts, the bracket so far shaded, and
/// their distances from the value that was found. `name`: of the scalar, with its unit.
std::string bisect_figure(const std::string& title, const std::string& name,
                          const search::Bisection& found, const design::BisectChoices& choices);

/// "yes", "no", "undecided" or "refused".
const char* word_of(search::Answer answer);

/// "yes", "no", "undecided", "refused" or "interrupted".
std::string verdict_of(const design::ScanRow& row);

}  // namespace gainsmith::app
