// Runs as pictures: states with their estimates, errors, inputs, claims, and planes.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "gainsmith/corrections.h"
#include "gainsmith/run_table.h"
#include "model/design.h"
#include "drawing/figure.h"
#include "verify/replay.h"

namespace gainsmith::app {

/// An estimate and the covariance of its error, of one observer or of each that has both.
struct Covariance {
  std::string estimate;
  std::string covariance;
};

/// What a picture of runs shows.
struct RunView {
  /// Names of quantities ("x", "x1", "ekf.xh1", a claim) or of groups (panel_groups()), in order.
  /// Empty: the usual ones.
  std::vector<std::string> panels;
  std::vector<std::pair<std::string, std::string>> planes;  ///< across and up
  std::vector<Covariance> covariances;                      ///< bands of +- 2 sigma
  std::map<std::string, std::vector<std::string>> units;    ///< of names, without observers or with
  std::set<std::string> inputs;                             ///< signals that are inputs
};

/// A run of a picture.
struct DrawnRun {
  std::uint64_t number = 0;
  verify::Replay replay;
  std::vector<Correction> corrections{};
};

/// "states", "errors", "inputs", "claims".
const std::vector<std::string>& panel_groups();

/// What the problem of a design says, with the usual panels.
RunView view_of(const model::Design& design);

/// The unit of a column; empty: none is stated.
std::string unit_of(const RunView& view, const verify::Column& column);

/// A run of a number with what a picture needs: points so dense that curves have no corners, 12,000
/// at most (those of `step` where it is positive), and the rounding of all values.
DrawnRun drawn_run(const verify::Setup& setup, std::uint64_t number, hybrid::Trajectory run,
                   double step);

/// The runs, all of one setup. One run: the plant solid, observers dashed, each in a colour
/// of its own; several: each run in a colour of its own. What is not larger than its rounding is 0.
/// Claims of sizes far apart, of other units or signs, are in panels of their own, with their
/// bounds. Planes of states of the plant show its field and level curves of claims
/// (plane_background.h). InputError, with the option as its place, for names that no column has, and
/// for bands of what has none.
drawing::Figure run_figure(const std::string& title, const claims::RunSetup& setup,
                          const std::vector<DrawnRun>& runs, RunView view);

}  // namespace gainsmith::app
