// The interior-point loop.
#pragma once

#include <limits>
#include <optional>
#include <type_traits>

#include "sdp/core/iterate.h"
#include "sdp/core/newton.h"
#include "sdp/core/presolve.h"
#include "sdp/core/residuals.h"
#include "sdp/solver.h"

namespace gainsmith::sdp {

/// From this error on a solution is in sight: it ends what is tried without one, and is where an
/// arithmetic hands over to the next.
inline constexpr double kInSight = 1e-3;

/// When to leave the rest to a wider arithmetic: as soon as a direction is imprecise (newton.h), or
/// only where this arithmetic is exhausted.
enum class Leave { never, exhausted, imprecise };

/// What one run of the loop is to do.
struct Run {
  Model model = Model::fixed;
  double aim = 1e-8;          ///< for all errors: stop here; what is below the tolerance counts
  double feasibility = 1e-8;  ///< for the two infeasibilities, where that is to be stricter
  Leave leave = Leave::never;
  int patience = 25;        ///< iterations without progress far from a solution
  int first_iteration = 0;  ///< continues the count of an earlier run
  bool early = false;       ///< Options::enough may end it
};

/// Predictor-corrector (Mehrotra 1992) on the model of newton.h in the arithmetic of T. With a_P
/// and a_D the longest steps <= 1 along the predictor (sigma = 0), an iteration takes
///   fixed tau:    sigma = (mu that the predictor reaches / mu)^max(1, 3 min(a_P, a_D)^2), eta = 1;
///   homogeneous:  sigma = (1 - a)^3, eta = 1 - sigma, a = a_P = a_D;
///   steps:        min(1, g b) with b the longest along the corrected direction,
///                 g = 0.9 + 0.08 min(a_P, a_D).
/// Exponent and step rule are after Toh, Todd & Tutuncu (1999).
template <typename T>
class Ipm {
 public:
  Ipm(const Problem& problem, const Presolved& presolved, const Options& options);

  /// X = far_X I, Y = far_Y I of presolve.h, `factor` times farther: for a fixed tau.
  void start_far(double factor);
  /// X = Y = I, tau = kappa = 1: for the homogeneous model, which finds the scale itself.
  void start_at_identity();
  /// The best point of an earlier run in a narrower arithmetic, moved into the cone where rounding
  /// there had hidden that it is outside.
  template <typename Narrow>
  void start_from(const Iterate<Narrow>& point) {
    convert(point, point_);
    if constexpr (!std::is_same_v<Narrow, T>) newton_.stay_wide();
    lift(static_cast<double>(std::numeric_limits<Narrow>::epsilon()));
  }

  /// Iterates until something ends it, a stop (base/stop.h) for one.
  Cause run(const Run& run);

  /// Afterwards: the best point found (least worst error), or the last one when it converged or
  /// shows infeasibility; and its residuals.
  const Iterate<T>& point() const { return point_; }
  const Residuals<T>& residuals() const { return residuals_; }
  int iterations() const { return iteration_; }
  /// Did the run leave the rest to a wider arithmetic (Run::leave)?
  bool left() const { return left_; }

 private:
  /// x = 0, multiples X and Y of I, tau = kappa = 1.
  void start(const T& X, const T& Y);
  void lift(double rounding);
  Cause iterate_or_stop();
  Cause iterate();
  /// Are all errors within `tolerance`, and both infeasibilities within Run::feasibility or the
  /// rounding that this arithmetic leaves in them?
  bool satisfied(double tolerance) const;
  /// Why to end at the present point; none to go on.
  std::optional<Cause> stop() const;
  std::optional<Cause> limits() const;
  /// Asks Options::enough about x of the original problem.
  bool is_enough() const;
  /// Is the last direction the sign at which Run::leave ends the run?
  bool leaves() const;
  T centering(const Steps<T>& reach) const;
  Steps<T> shortened(const Steps<T>& longest, const Steps<T>& reach) const;
  bool advance(Steps<T>& step);
  /// Keeps the point of the least worst error. Progress is a better point within kInSight, an error
  /// that was halved farther off, or a certificate residual that was halved.
  void keep_best();
  void report(const Steps<T>& step) const;

  const Problem& problem_;
  const Presolved& presolved_;
  const Options& options_;
  Run run_;
  Iterate<T> point_, best_, predictor_, direction_;
  Residuals<T> residuals_;
  Newton<T> newton_;
  int iteration_ = 0;
  double best_error_ = 0;
  double progress_error_ = 0;  ///< of the last point that was progress
  /// Smallest certificate residual so far: its progress counts, but a problem with an optimum may
  /// pass near one before it reaches that.
  double best_certificate_ = 0;
  int since_best_ = 0;
  bool left_ = false;
};

}  // namespace gainsmith::sdp
