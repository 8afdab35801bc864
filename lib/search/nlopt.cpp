#include "search/nlopt.h"

#include <nlopt.h>

#include <exception>
#include <memory>
#include <new>
#include <vector>

namespace gainsmith::search {

namespace {

/// What NLopt's callback needs, and the best point so far.
struct Run {
  const std::function<double(const std::vector<double>&)>& function;
  const std::function<bool()>& go_on;
  const LocalSearchOptions& options;
  nlopt_opt optimizer = nullptr;
  int evaluations = 0;
  bool stopped = false;  ///< by go_on, by an exception or by reaching the target
  std::vector<double> best{};
  double best_value = 0;
  std::exception_ptr failure{};

  void stop() {
    stopped = true;
    nlopt_force_stop(optimizer);
  }
};

/// NLopt is C: an exception must not pass through it.
double evaluate(unsigned count, const double* x, double*, void* data) {
  Run& run = *static_cast<Run*>(data);
  constexpr double kNothing = 1e300;
  try {
    if (run.stopped || !run.go_on()) {
      run.stop();
      return kNothing;
    }
    const std::vector<double> point(x, x + count);
    const double value = run.function(point);
    ++run.evaluations;
    if (run.best.empty() || value < run.best_value) {
      run.best = point;
      run.best_value = value;
    }
    if (run.options.target && value <= *run.options.target) run.stop();
    return value;
  } catch (...) {
    run.failure = std::current_exception();
    run.stop();
    return kNothing;
  }
}

void search(nlopt_algorithm algorithm, Run& run, std::vector<double> start, double step) {
  const LocalSearchOptions& options = run.options;
  if (run.stopped || run.evaluations >= options.evaluations) return;
  const auto count = static_cast<unsigned>(start.size());
  const std::unique_ptr<nlopt_opt_s, decltype(&nlopt_destroy)> optimizer(
      nlopt_create(algorithm, count), nlopt_destroy);
  if (!optimizer) throw std::bad_alloc();
  run.optimizer = optimizer.get();
  nlopt_set_min_objective(run.optimizer, evaluate, &run);
  nlopt_set_lower_bounds1(run.optimizer, 0);
  nlopt_set_upper_bounds1(run.optimizer, 1);
  nlopt_set_initial_step1(run.optimizer, step);
  nlopt_set_xtol_abs1(run.optimizer, options.tolerance);
  nlopt_set_maxeval(run.optimizer, options.evaluations - run.evaluations);
  double value = 0;
  // The result code does not matter: the best point is kept by the callback.
  nlopt_optimize(run.optimizer, start.data(), &value);
  if (run.failure) std::rethrow_exception(run.failure);
}

}  // namespace

LocalSearch nlopt_search() {
  return [](const std::function<double(const std::vector<double>&)>& function,
            const std::vector<double>& start, const LocalSearchOptions& options,
            const std::function<bool()>& go_on) {
    Run run{function, go_on, options};
    search(NLOPT_LN_NELDERMEAD, run, start, options.step);
    // BOBYQA needs two coordinates. Its first steps reach as far as the simplex was uncertain.
    constexpr double kRefine = 0.1;
    if (start.size() >= 2 && !run.best.empty())
      search(NLOPT_LN_BOBYQA, run, run.best, kRefine * options.step);
  };
}

}  // namespace gainsmith::search
