// Internal to verify: a figure of a design with the values of a setup.
#pragma once

#include <optional>

#include "claims/run_figures.h"
#include "claims/run_setup.h"
#include "model/figure.h"

namespace gainsmith::statistics {

class BoundFigure {
 public:
  /// InputError where a name of the figure has no value. The setup must outlive it.
  BoundFigure(const model::Figure& figure, const claims::RunSetup& setup);
  BoundFigure(const BoundFigure&) = delete;
  BoundFigure& operator=(const BoundFigure&) = delete;

  std::optional<double> of(const hybrid::Trajectory& run) { return (*number_)(run); }
  /// Of the last run, of `nees` and `nis`.
  const claims::Squares& squares() const { return number_->squares(); }

 private:
  std::optional<expr::Program> program_;  ///< that the value of the figure reads
  std::optional<claims::FigureOf> number_;
};

}  // namespace gainsmith::statistics
