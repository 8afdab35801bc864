// The interior-point loop.
#pragma once

#include <chrono>
#include <optional>

#include "sdp/iterate.h"
#include "sdp/newton.h"
#include "sdp/presolve.h"
#include "sdp/residuals.h"
#include "sdp/solver.h"

namespace gainsmith::sdp {

/// Predictor-corrector (Mehrotra) on the homogeneous model of newton.h, in the arithmetic of T.
template <typename T>
class Ipm {
 public:
  using Clock = std::chrono::steady_clock;

  /// `first_iteration` continues the count of an earlier run; `start` is that of the whole solve.
  Ipm(const Problem& problem, const Presolved& presolved, const Options& options,
      Clock::time_point start, int first_iteration = 0);

  /// Iterates from `point()` until something stops it.
  Cause run();

  /// The point to start from, and afterwards the best point found (least worst error), or the last
  /// one when it shows infeasibility.
  Iterate<T>& point() { return point_; }
  const Residuals<T>& residuals() const { return residuals_; }
  int iterations() const { return iteration_; }

 private:
  Cause iterate();
  std::optional<Cause> stop();
  std::optional<Cause> limits() const;
  void keep_best();
  void report(const T& step) const;

  const Presolved& presolved_;
  const Options& options_;
  Clock::time_point start_;
  Iterate<T> point_, best_, predictor_, direction_;
  Residuals<T> residuals_;
  Newton<T> newton_;
  int iteration_;
  double best_error_;
  int since_best_ = 0;
};

}  // namespace gainsmith::sdp
