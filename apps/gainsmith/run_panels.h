// Internal to pictures of runs: what the panels show, whatever the run.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gainsmith/run_figure.h"
#include "drawing/figure.h"

namespace gainsmith::app {

/// A line of a panel, for each run.
struct PlannedLine {
  std::vector<std::size_t> columns;   ///< of several their size
  std::optional<std::size_t> across;  ///< of a plane: the column across
  std::string label;
  bool dashed = false;
  int colour = 0;
  bool size = false;  ///< the root of the sum of the squares of the columns
};

/// +- 2 sigma around an estimate.
struct PlannedBand {
  std::size_t estimate = 0;
  std::size_t variance = 0;
  int colour = 0;
};

struct PlannedPanel {
  std::string title;
  std::string unit;
  bool logarithmic = false;
  std::vector<PlannedLine> lines;
  std::vector<PlannedBand> bands{};
  std::optional<std::string> across{};  ///< the name across a plane
  std::vector<std::size_t> claims{};    ///< instead of lines: see claim_panels()
};

/// The panels that a view asks for, but its planes. InputError as run_figure().
std::vector<PlannedPanel> planned_panels(const verify::Replay& replay, const RunView& view);

/// Of a plane for each pair of names.
std::vector<PlannedPanel> planned_planes(const verify::Replay& replay, const RunView& view);

/// The values of a column, 0 where they are rounding.
std::vector<double> values_of(const verify::Replay& replay, std::size_t column);

/// A curve with the times, jumps and label of a line.
drawing::Curve curve_of(const verify::Replay& replay, const PlannedLine& line);

/// What a panel shows of the runs.
drawing::Panel panel_of(const PlannedPanel& planned, const std::vector<DrawnRun>& runs);

/// Panels of the claims that are wanted (columns).
std::vector<drawing::Panel> claim_panels(const std::vector<std::size_t>& claims,
                                        const std::vector<DrawnRun>& runs, const RunView& view);

}  // namespace gainsmith::app
