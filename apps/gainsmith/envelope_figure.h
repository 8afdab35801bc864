// Many runs as a picture: between which values each quantity lies over time.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gainsmith/run_panels.h"
#include "statistics/value_sketch.h"

namespace gainsmith::app {

/// Quantiles of runs at equally spaced times, in memory that does not grow with their number.
class EnvelopeFigure {
 public:
  /// Over the times from 0 to the horizon.
  EnvelopeFigure(double horizon, RunView view);

  /// How far apart the points of flows of the runs should be.
  double step() const { return step_; }
  /// All runs are of one setup. A run that ends early counts up to its end.
  void add(const verify::Replay& run);

  /// For each line of the usual panels, or of those of the view, but claims and planes: its
  /// median, the band from 5 to 95 % of the runs, the least and the largest value.
  drawing::Figure figure(const std::string& title);

 private:
  /// Of a line of a panel, by time.
  struct Spread {
    std::vector<std::vector<double>> fresh;  ///< values that are not in the sketches yet
    std::vector<statistics::ValueSketch> values;
  };

  void settle();
  drawing::Panel panel_of(const PlannedPanel& planned, std::size_t first) const;

  static constexpr std::size_t kTimes = 401;

  double step_;
  RunView view_;
  std::vector<PlannedPanel> panels_;  ///< known from the first run on
  std::string axis_;
  std::vector<Spread> lines_;  ///< of all panels, in order
  std::size_t fresh_ = 0;      ///< runs
};

}  // namespace gainsmith::app
