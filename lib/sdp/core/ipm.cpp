#include "sdp/core/ipm.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/scalars.h"
#include "base/stop.h"

namespace gainsmith::sdp {
namespace {

/// Of the distance to the boundary: closer when the predictor got far.
constexpr double kShortest = 0.9, kLongest = 0.98;
/// Iterations without a better point before the arithmetic counts as exhausted once a solution is
/// in sight; before, errors may still rise before they fall.
constexpr int kPatienceNear = 4;
/// Far from a solution, a point that is better by less than this factor is no progress.
constexpr double kProgress = 0.5;
/// A step below this gets nowhere.
constexpr double kNoStep = 1e-7;
/// Part of a step taken back when it leaves the cone, and how often.
constexpr double kRetreat = 0.125;
constexpr int kRetreats = 6;
/// Roundings that bring a point back into the cone: from one on, each time more, so often.
constexpr double kLiftGrowth = 8;
constexpr int kLifts = 6;
/// Infeasibility of so many roundings is none.
constexpr double kRounding = 10;
/// The least sigma at a fixed tau.
constexpr double kLeastCentering = 1e-6;

}  // namespace

template <typename T>
Ipm<T>::Ipm(const Problem& problem, const Presolved& presolved, const Options& options)
    : problem_(problem),
      presolved_(presolved),
      options_(options),
      point_(presolved.data),
      best_(presolved.data),
      predictor_(presolved.data),
      direction_(presolved.data),
      residuals_(problem, presolved),
      newton_(presolved.data, options.threads) {}

template <typename T>
void Ipm<T>::start_far(double factor) {
  start(T(presolved_.far_X * factor), T(presolved_.far_Y * factor));
}

template <typename T>
void Ipm<T>::start_at_identity() {
  start(T(1), T(1));
}

template <typename T>
void Ipm<T>::start(const T& X, const T& Y) {
  point_.x.setZero();
  point_.X.set_identity(X);
  point_.Y.set_identity(Y);
  point_.tau = point_.kappa = T(1);
}

/// Adds a few roundings of its largest entry to the diagonal of every block, as many as it takes.
template <typename T>
void Ipm<T>::lift(double rounding) {
  for (int k = 0; k < kLifts && !newton_.factorise(point_); ++k, rounding *= kLiftGrowth)
    for (Blocks<T>* const V : {&point_.X, &point_.Y})
      for (int b = 0; b < V->layout().blocks(); ++b) {
        auto diagonal = V->dense(b).diagonal();
        diagonal.array() += T(rounding) * diagonal.maxCoeff();
      }
}

template <typename T>
Cause Ipm<T>::run(const Run& run) {
  run_ = run;
  iteration_ = run.first_iteration;
  best_error_ = progress_error_ = best_certificate_ = std::numeric_limits<double>::infinity();
  since_best_ = 0;
  left_ = false;
  const Cause cause = iterate_or_stop();
  if (cause != Cause::converged && cause != Cause::certificate && cause != Cause::enough) {
    const Concluding concluding;
    point_ = best_;
    residuals_.update(point_);
    if (satisfied(options_.tolerance)) return Cause::converged;
  }
  return cause;
}

template <typename T>
Cause Ipm<T>::iterate_or_stop() {
  try {
    return iterate();
  } catch (const Stopped&) {
    if (!std::isfinite(best_error_)) best_ = point_;
    return Cause::interrupted;
  }
}

/// Until stop() or a failure ends it. Directions aim at X Y = sigma mu I; a step that leaves the
/// cone is taken back in part.
template <typename T>
Cause Ipm<T>::iterate() {
  residuals_.update(point_);
  if (!newton_.factorise(point_)) return Cause::numerical_breakdown;
  Steps<T> step;
  for (;; ++iteration_) {
    report(step);
    keep_best();
    if (const auto cause = stop()) return *cause;
    if (!newton_.prepare(point_, residuals_.defect, run_.model,
                         run_.feasibility * residuals_.dual_unit()))
      return Cause::numerical_breakdown;

    newton_.predict(point_, residuals_.defect, predictor_);
    const Steps<T> reach = newton_.step(point_, predictor_, T(1));
    const T sigma = centering(reach);
    const T eta = run_.model == Model::fixed ? T(1) : T(T(1) - sigma);
    newton_.correct(point_, residuals_.defect, predictor_, sigma, eta, direction_);
    left_ = leaves();
    if (left_) return Cause::stalled;

    step = shortened(newton_.step(point_, direction_, T(2)), reach);
    if (!(static_cast<double>(std::max(step.primal, step.dual)) > kNoStep)) return Cause::stalled;
    if (!advance(step)) return Cause::numerical_breakdown;
    residuals_.update(point_);
  }
}

/// Moves along the direction and factors; takes back a part of the step as long as that fails,
/// since the longest step is an estimate.
template <typename T>
bool Ipm<T>::advance(Steps<T>& step) {
  point_.advance(direction_, step.primal, step.dual);
  for (int retreat = 0; !newton_.factorise(point_); ++retreat) {
    if (retreat == kRetreats) return false;
    const T back = T(kRetreat);
    point_.advance(direction_, -back * step.primal, -back * step.dual);
    step = {(T(1) - back) * step.primal, (T(1) - back) * step.dual};
  }
  return true;
}

/// sigma = (1 - a)^3 in the homogeneous model; at a fixed tau the ratio of the mu that the
/// predictor reaches to the present one, to a power that grows with the steps.
template <typename T>
T Ipm<T>::centering(const Steps<T>& reach) const {
  if (run_.model == Model::homogeneous) {
    const T left = T(1) - reach.primal;
    return left * left * left;
  }
  const Blocks<T>&X = point_.X, &Y = point_.Y;
  const T now = inner(X, Y);
  const T reached = now + reach.primal * inner(predictor_.X, Y) +
                    reach.dual * inner(X, predictor_.Y) +
                    reach.primal * reach.dual * inner(predictor_.X, predictor_.Y);
  const double ratio = static_cast<double>(T(reached / now));
  const double shorter = static_cast<double>(std::min(reach.primal, reach.dual));
  const double exponent = std::max(1.0, 3 * shorter * shorter);
  return T(std::clamp(std::pow(std::max(ratio, 0.0), exponent), kLeastCentering, 1.0));
}

/// The steps that are taken, at most 1: a share of the longest that grows with the predictor's.
template <typename T>
Steps<T> Ipm<T>::shortened(const Steps<T>& longest, const Steps<T>& reach) const {
  const T gamma = T(kShortest) + T(kLongest - kShortest) * std::min(reach.primal, reach.dual);
  return {std::min(T(1), T(gamma * longest.primal)), std::min(T(1), T(gamma * longest.dual))};
}

template <typename T>
bool Ipm<T>::satisfied(double tolerance) const {
  const Residuals<T>& r = residuals_;
  return r.worst() <= tolerance &&
         r.primal_infeasibility <= run_.feasibility + kRounding * r.primal_rounding &&
         r.dual_infeasibility <= run_.feasibility + kRounding * r.dual_rounding;
}

template <typename T>
std::optional<Cause> Ipm<T>::stop() const {
  if (satisfied(run_.aim)) return Cause::converged;
  // Half of the tolerance: what is recomputed from the raw data has to meet all of it.
  if (std::min(residuals_.primal_certificate, residuals_.dual_certificate) <=
      options_.certificate_tolerance / 2)
    return Cause::certificate;
  if (!std::isfinite(residuals_.worst())) return Cause::numerical_breakdown;
  if (is_enough()) return Cause::enough;
  if (since_best_ > (best_error_ < kInSight ? kPatienceNear : run_.patience)) return Cause::stalled;
  return limits();
}

template <typename T>
std::optional<Cause> Ipm<T>::limits() const {
  if (iteration_ >= options_.iteration_limit) return Cause::iteration_limit;
  if (is_stopping()) return Cause::interrupted;
  return std::nullopt;
}

template <typename T>
bool Ipm<T>::is_enough() const {
  if (!run_.early || !options_.enough) return false;
  // x_i = gamma_f s_i x'_i / tau (presolve.h).
  const Recovery& recovery = presolved_.recovery;
  std::vector<double> x(problem_.c.size(), 0.0);
  for (std::size_t i = 0; i < recovery.constraint.size(); ++i)
    x[static_cast<std::size_t>(recovery.constraint[i])] =
        static_cast<double>(T(point_.x[static_cast<Eigen::Index>(i)] / point_.tau)) *
        (recovery.gamma_f * recovery.s[i]);
  return options_.enough(x);
}

template <typename T>
bool Ipm<T>::leaves() const {
  return (run_.leave == Leave::exhausted && newton_.exhausted()) ||
         (run_.leave == Leave::imprecise && newton_.imprecise());
}

template <typename T>
void Ipm<T>::keep_best() {
  ++since_best_;
  const double certificate = std::min(residuals_.primal_certificate, residuals_.dual_certificate);
  if (certificate < kProgress * best_certificate_) {
    best_certificate_ = certificate;
    since_best_ = 0;
  }
  const double error = residuals_.worst();
  if (!(error < best_error_)) return;
  best_error_ = error;
  best_ = point_;
  if (error > kInSight && !(error < kProgress * progress_error_)) return;
  progress_error_ = error;
  since_best_ = 0;
}

template <typename T>
void Ipm<T>::report(const Steps<T>& step) const {
  if (!options_.progress) return;
  Progress line;
  line.iteration = iteration_;
  line.precision = name_of<T>();
  line.primal_objective = residuals_.primal_objective;
  line.dual_objective = residuals_.dual_objective;
  line.relative_gap = residuals_.gap;
  line.primal_infeasibility = residuals_.primal_infeasibility;
  line.dual_infeasibility = residuals_.dual_infeasibility;
  line.step_primal = static_cast<double>(step.primal);
  line.step_dual = static_cast<double>(step.dual);
  options_.progress(line);
}

#define GAINSMITH_INSTANTIATE(T) template class Ipm<T>;
GAINSMITH_FOR_EACH_SCALAR(GAINSMITH_INSTANTIATE)
#undef GAINSMITH_INSTANTIATE

}  // namespace gainsmith::sdp
