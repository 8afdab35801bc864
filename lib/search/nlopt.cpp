#include "search/nlopt.h"

#include <nlopt.h>

#include <exception>
#include <memory>
#include <new>
#include <vector>

#include "base/shared_library.h"

namespace gainsmith::search {

namespace {

/// The functions of the library.
struct Nlopt {
  SharedLibrary library{GAINSMITH_NLOPT_FILE, kNeedsOptimizers};
#define GAINSMITH_FUNCTION(name) \
  decltype(nlopt_##name)* name = library.function<decltype(nlopt_##name)>("nlopt_" #name)
  GAINSMITH_FUNCTION(create);
  GAINSMITH_FUNCTION(destroy);
  GAINSMITH_FUNCTION(force_stop);
  GAINSMITH_FUNCTION(optimize);
  GAINSMITH_FUNCTION(set_initial_step1);
  GAINSMITH_FUNCTION(set_lower_bounds1);
  GAINSMITH_FUNCTION(set_maxeval);
  GAINSMITH_FUNCTION(set_min_objective);
  GAINSMITH_FUNCTION(set_upper_bounds1);
  GAINSMITH_FUNCTION(set_xtol_abs1);
  GAINSMITH_FUNCTION(srand);
#undef GAINSMITH_FUNCTION
};

const Nlopt& nlopt() {
  static const Nlopt kLoaded;
  return kLoaded;
}

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
    nlopt().force_stop(optimizer);
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

/// One run of an algorithm in the unit box; what it finds is in `run`.
void search(nlopt_algorithm algorithm, Run& run, std::vector<double> start, double step) {
  const LocalSearchOptions& options = run.options;
  if (run.stopped || run.evaluations >= options.evaluations) return;
  const auto count = static_cast<unsigned>(start.size());
  const std::unique_ptr<nlopt_opt_s, decltype(&nlopt_destroy)> optimizer(
      nlopt().create(algorithm, count), nlopt().destroy);
  if (!optimizer) throw std::bad_alloc();
  run.optimizer = optimizer.get();
  nlopt().set_min_objective(run.optimizer, evaluate, &run);
  nlopt().set_lower_bounds1(run.optimizer, 0);
  nlopt().set_upper_bounds1(run.optimizer, 1);
  nlopt().set_initial_step1(run.optimizer, step);
  nlopt().set_xtol_abs1(run.optimizer, options.tolerance);
  nlopt().set_maxeval(run.optimizer, options.evaluations - run.evaluations);
  double value = 0;
  // The result code does not matter: the best point is kept by the callback.
  nlopt().optimize(run.optimizer, start.data(), &value);
  if (run.failure) std::rethrow_exception(run.failure);
}

}  // namespace

LocalSearch nlopt_search() {
  nlopt();
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

LocalSearch nlopt_global_search(unsigned long seed) {
  nlopt();
  return [seed](const std::function<double(const std::vector<double>&)>& function,
                const std::vector<double>& start, const LocalSearchOptions& options,
                const std::function<bool()>& go_on) {
    Run run{function, go_on, options};
    // The library keeps a generator for each thread.
    nlopt().srand(seed);
    search(NLOPT_GN_CRS2_LM, run, start, options.step);
  };
}

}  // namespace gainsmith::search
