#include "sdp/ipm.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sdp/scalars.h"

namespace gainsmith::sdp {
namespace {

/// Of the way to the boundary: closer when the predictor got far.
constexpr double kShortest = 0.9, kLongest = 0.98;
/// Iterations without a better point before the arithmetic counts as exhausted.
constexpr int kPatience = 12;
/// A step below this gets nowhere.
constexpr double kNoStep = 1e-7;

double largest(const std::vector<double>& values) {
  double result = 0;
  for (const double v : values) result = std::max(result, std::abs(v));
  return result;
}

double largest(const std::vector<Entry>& entries) {
  double result = 0;
  for (const Entry& e : entries) result = std::max(result, std::abs(e.value));
  return result;
}

}  // namespace

template <typename T>
Ipm<T>::Ipm(const Problem& problem, const Presolved& presolved, const Options& options,
            Clock::time_point start, int first_iteration)
    : presolved_(presolved),
      options_(options),
      start_(start),
      point_(presolved.data),
      best_(presolved.data),
      predictor_(presolved.data),
      direction_(presolved.data),
      residuals_(presolved, largest(problem.c), largest(problem.f[0]),
                 frobenius_norm(problem.f[0])),
      newton_(presolved.data, options.threads),
      iteration_(first_iteration),
      best_error_(std::numeric_limits<double>::infinity()) {
  point_.X.set_identity(T(1));
  point_.Y.set_identity(T(1));
}

template <typename T>
Cause Ipm<T>::run() {
  const Cause cause = iterate();
  if (cause != Cause::converged && cause != Cause::certificate) {
    point_ = best_;
    residuals_.update(point_);
  }
  return cause;
}

template <typename T>
Cause Ipm<T>::iterate() {
  residuals_.update(point_);
  T step(0);
  for (;; ++iteration_) {
    report(step);
    keep_best();
    if (const auto cause = stop()) return *cause;
    if (!newton_.prepare(point_, residuals_)) return Cause::numerical_breakdown;

    newton_.predict(point_, residuals_, predictor_);
    const T reach = newton_.step(point_, predictor_, T(1));
    const T sigma = (T(1) - reach) * (T(1) - reach) * (T(1) - reach);
    newton_.correct(point_, residuals_, predictor_, sigma, T(1) - sigma, direction_);

    const T gamma = T(kShortest) + T(kLongest - kShortest) * reach;
    step = std::min(T(1), T(gamma * newton_.step(point_, direction_, T(1) / gamma)));
    if (!(static_cast<double>(step) > kNoStep)) return Cause::stalled;
    point_.advance(direction_, step);
    residuals_.update(point_);
  }
}

template <typename T>
std::optional<Cause> Ipm<T>::stop() {
  if (residuals_.worst() <= options_.tolerance) return Cause::converged;
  if (residuals_.primal_certificate <= options_.certificate_tolerance / 2 ||
      residuals_.dual_certificate <= options_.certificate_tolerance / 2)
    return Cause::certificate;
  if (since_best_ > kPatience) return Cause::stalled;
  return limits();
}

template <typename T>
std::optional<Cause> Ipm<T>::limits() const {
  if (iteration_ >= options_.iteration_limit) return Cause::iteration_limit;
  if (options_.interrupted && options_.interrupted()) return Cause::interrupted;
  if (options_.time_limit > 0 &&
      std::chrono::duration<double>(Clock::now() - start_).count() > options_.time_limit)
    return Cause::time_limit;
  return std::nullopt;
}

template <typename T>
void Ipm<T>::keep_best() {
  const double error =
      std::min({residuals_.worst(), residuals_.primal_certificate, residuals_.dual_certificate});
  ++since_best_;
  if (!(error < best_error_)) return;
  best_error_ = error;
  best_ = point_;
  since_best_ = 0;
}

template <typename T>
void Ipm<T>::report(const T& step) const {
  if (!options_.progress) return;
  Progress line;
  line.iteration = iteration_;
  line.primal_objective = residuals_.primal_objective;
  line.dual_objective = residuals_.dual_objective;
  line.relative_gap = residuals_.gap;
  line.primal_infeasibility = residuals_.primal_infeasibility;
  line.dual_infeasibility = residuals_.dual_infeasibility;
  line.step_primal = line.step_dual = static_cast<double>(step);
  options_.progress(line);
}

#define GAINSMITH_INSTANTIATE(T) template class Ipm<T>;
GAINSMITH_FOR_EACH_SCALAR(GAINSMITH_INSTANTIATE)
#undef GAINSMITH_INSTANTIATE

}  // namespace gainsmith::sdp
