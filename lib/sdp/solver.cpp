#include "sdp/solver.h"

#include <chrono>

#include "sdp/ipm.h"
#include "sdp/presolve.h"
#include "sdp/report.h"

namespace gainsmith::sdp {
namespace {

using Clock = std::chrono::steady_clock;

/// F_i = 0 with c_i != 0: x = -e_i / c_i.
Solution free_descent(const Problem& problem, const Presolved& presolved, const Options& options) {
  Solution solution;
  const Iterate<double> zero(presolved.data);
  Point point = restore(problem, presolved, zero.x, zero.X, zero.Y, 1.0);
  const auto i = static_cast<std::size_t>(presolved.free_descent);
  point.x[i] = -1 / problem.c[i];
  solution.certificate = check_dual_infeasible(problem, point, options.certificate_tolerance);
  solution.status = Status::dual_infeasible;
  solution.cause = Cause::certificate;
  solution.x = std::move(point.x);
  solution.X = std::move(point.X);
  solution.Y = std::move(point.Y);
  return solution;
}

/// What the run showed, judged on the raw problem alone.
template <typename T>
void conclude(const Problem& problem, const Presolved& presolved, const Options& options,
              Ipm<T>& ipm, Cause cause, Solution& solution) {
  const Iterate<T>& end = ipm.point();
  const Residuals<T>& residuals = ipm.residuals();
  solution.cause = cause;
  solution.iterations = ipm.iterations();
  Point point = restore(problem, presolved, end.x, end.X, end.Y,
                        cause == Cause::certificate ? T(1) : end.tau);
  measure(problem, point, solution);
  if (cause == Cause::converged) solution.status = Status::optimal;
  if (cause == Cause::certificate) {
    const bool primal = residuals.primal_certificate <= residuals.dual_certificate;
    solution.certificate =
        primal ? check_primal_infeasible(problem, point, options.certificate_tolerance)
               : check_dual_infeasible(problem, point, options.certificate_tolerance);
    if (solution.certificate.checked)
      solution.status = primal ? Status::primal_infeasible : Status::dual_infeasible;
  }
  solution.x = std::move(point.x);
  solution.X = std::move(point.X);
  solution.Y = std::move(point.Y);
}

}  // namespace

Solution solve(const Problem& problem, const Options& options) {
  const Clock::time_point start = Clock::now();
  validate(problem);
  const Presolved presolved = presolve(problem);
  Solution solution;
  if (presolved.free_descent >= 0) {
    solution = free_descent(problem, presolved, options);
  } else {
    Ipm<double> ipm(problem, presolved, options, start);
    const Cause cause = ipm.run();
    conclude(problem, presolved, options, ipm, cause, solution);
  }
  solution.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return solution;
}

}  // namespace gainsmith::sdp
