// A figure of a design with the values of a setup, and an estimate of its error.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "claims/run_figures.h"
#include "claims/run_setup.h"
#include "claims/text_ball.h"
#include "claims/twin_runs.h"
#include "model/figure.h"

namespace gainsmith::statistics {

/// The number of a figure with an estimate of its error: four times the difference of the two runs
/// (64 times where flows are exact, claims/twin_parts.h), the accuracy of the run, what its steps
/// round, each once, and what the computation of the figure rounds. Where that leaves open on which
/// side of a step a value lies, as of a number that is rounded, the error reaches both.
struct Estimate {
  std::optional<double> value;  ///< none: the run has no such number
  double error = 0;             ///< infinite: the number is not known
  std::string why;              ///< ... as

  bool known() const { return std::isfinite(error); }
};

class BoundFigure {
 public:
  /// InputError where a name of the figure has no value. The setup must outlive it.
  BoundFigure(const model::Figure& figure, const claims::RunSetup& setup);
  BoundFigure(const BoundFigure&) = delete;
  BoundFigure& operator=(const BoundFigure&) = delete;

  std::optional<double> of(const hybrid::Trajectory& run) { return (*number_)(run); }
  /// With its error; not known where the two runs have parted or disagree on which events happen.
  Estimate of(const claims::TwinRun& runs);
  /// Of the last run, of `nees` and `nis`.
  const claims::Squares& squares() const { return number_->squares(); }

 private:
  double rounding(double value, const Eigen::VectorXd& twin);

  const claims::RunSetup* setup_;
  std::optional<expr::Program> program_;  ///< that the value of the figure reads
  std::optional<claims::FigureOf> number_;
  std::optional<claims::TextBall> ball_;  ///< of the program
  std::vector<Eigen::Index> elements_;    ///< of the variables that decide about it
  /// Whether it is at an event that happens on one side of a guard: texts that branch there do so
  /// on that side.
  bool is_at_guard_ = false;
  bool is_whole_ = false;  ///< a number of events
  bool rests_ = false;     ///< no flow changes it, and no sum over steps makes it
};

}  // namespace gainsmith::statistics
