#include "search/ipopt.h"

#include <coin/IpStdCInterface.h>

#include <algorithm>
#include <exception>
#include <memory>
#include <new>
#include <type_traits>

#include "base/shared_library.h"

namespace gainsmith::search {

namespace {

/// The functions of the library: its C interface.
struct Ipopt {
  SharedLibrary file{GAINSMITH_IPOPT_FILE, kNeedsOptimizers};
#define GAINSMITH_FUNCTION(member, name) \
  decltype(name)* const member = file.function<decltype(name)>(#name)
  GAINSMITH_FUNCTION(create, CreateIpoptProblem);
  GAINSMITH_FUNCTION(free, FreeIpoptProblem);
  GAINSMITH_FUNCTION(set_integer, AddIpoptIntOption);
  GAINSMITH_FUNCTION(set_number, AddIpoptNumOption);
  GAINSMITH_FUNCTION(set_text, AddIpoptStrOption);
  GAINSMITH_FUNCTION(set_iteration, SetIntermediateCallback);
  GAINSMITH_FUNCTION(solve, IpoptSolve);
#undef GAINSMITH_FUNCTION
};

const Ipopt& ipopt() {
  static const Ipopt kLoaded;
  return kLoaded;
}

/// What the callbacks need. Ipopt's interface is C: an exception must not pass through it, so the
/// first one is kept and ends the run.
struct SmoothRun {
  const SmoothProgram& program;
  int iterations = 0;
  std::exception_ptr failure{};
};

template <class Work>
Bool guarded(void* data, Work work) {
  SmoothRun& run = *static_cast<SmoothRun*>(data);
  if (run.failure) return FALSE;
  try {
    work(run);
    return TRUE;
  } catch (...) {
    run.failure = std::current_exception();
    return FALSE;
  }
}

std::vector<double> point(Index n, const Number* v) { return {v, v + n}; }

void copy(const std::vector<double>& from, Number* to) { std::copy(from.begin(), from.end(), to); }

Bool objective(Index n, Number* v, Bool, Number* value, void* data) {
  return guarded(data, [&](SmoothRun& run) { *value = run.program.objective(point(n, v)); });
}

Bool gradient(Index n, Number* v, Bool, Number* values, void* data) {
  return guarded(data, [&](SmoothRun& run) { copy(run.program.gradient(point(n, v)), values); });
}

Bool residuals(Index n, Number* v, Bool, Index, Number* values, void* data) {
  return guarded(data, [&](SmoothRun& run) { copy(run.program.residuals(point(n, v)), values); });
}

/// The places of the elements first, with null for `values`; then their values.
Bool jacobian(Index n, Number* v, Bool, Index, Index, Index* rows, Index* columns, Number* values,
              void* data) {
  return guarded(data, [&](SmoothRun& run) {
    if (values != nullptr) return copy(run.program.jacobian(point(n, v)), values);
    for (std::size_t k = 0; k < run.program.rows.size(); ++k) {
      rows[k] = static_cast<Index>(run.program.rows[k]);
      columns[k] = static_cast<Index>(run.program.columns[k]);
    }
  });
}

Bool hessian(Index, Number*, Bool, Number, Index, Number*, Bool, Index, Index*, Index*, Number*,
             void*) {
  return FALSE;
}

Bool iteration(Index, Index count, Number, Number, Number, Number, Number, Number, Number, Number,
               Index, void* data) {
  return guarded(data, [&](SmoothRun& run) { run.iterations = count; });
}

struct Free {
  void operator()(IpoptProblem problem) const { ipopt().free(problem); }
};
using Problem = std::unique_ptr<std::remove_pointer_t<IpoptProblem>, Free>;

/// c(v) = 0 as lower and upper bounds 0 of all constraints.
Problem problem_of(const SmoothProgram& program) {
  // Beyond 1e19 Ipopt takes a bound for none.
  constexpr double kIpoptInfinity = 2e19;
  constexpr Index kFromZero = 0;
  std::vector<double> low = program.low;
  std::vector<double> high = program.high;
  for (double& value : low) value = std::max(value, -kIpoptInfinity);
  for (double& value : high) value = std::min(value, kIpoptInfinity);
  std::vector<double> zeros(program.constraints);
  return Problem(ipopt().create(static_cast<Index>(low.size()), low.data(), high.data(),
                                static_cast<Index>(zeros.size()), zeros.data(), zeros.data(),
                                static_cast<Index>(program.rows.size()), 0, kFromZero, objective,
                                residuals, gradient, jacobian, hessian));
}

void set(IpoptProblem problem, std::string name, std::string value) {
  ipopt().set_text(problem, name.data(), value.data());
}

std::string cause_of(ApplicationReturnStatus status) {
  switch (status) {
    case Solve_Succeeded:
      return "converged";
    case Solved_To_Acceptable_Level:
      return "converged to an acceptable level";
    case Maximum_Iterations_Exceeded:
      return "iteration limit";
    case Infeasible_Problem_Detected:
      return "converged to an infeasible point";
    case Restoration_Failed:
      return "restoration failed";
    case Search_Direction_Becomes_Too_Small:
      return "steps became too short";
    default:
      return "stopped with Ipopt's code " + std::to_string(static_cast<int>(status));
  }
}

SmoothSolution solve(const SmoothProgram& program, double tolerance, int iterations) {
  const Problem problem = problem_of(program);
  if (!problem) throw std::bad_alloc();
  std::string tol = "tol", max_iter = "max_iter", print_level = "print_level";
  set(problem.get(), "sb", "yes");
  set(problem.get(), "hessian_approximation", "limited-memory");
  // No options file of the working folder is read.
  set(problem.get(), "option_file_name", "");
  ipopt().set_integer(problem.get(), print_level.data(), 0);
  ipopt().set_number(problem.get(), tol.data(), tolerance);
  ipopt().set_integer(problem.get(), max_iter.data(), iterations);
  ipopt().set_iteration(problem.get(), iteration);
  SmoothRun run{program};
  SmoothSolution solution;
  solution.v = program.start;
  std::vector<double> value(1);
  const auto status = ipopt().solve(problem.get(), solution.v.data(), nullptr, value.data(),
                                    nullptr, nullptr, nullptr, &run);
  if (run.failure) std::rethrow_exception(run.failure);
  solution.converged = status == Solve_Succeeded || status == Solved_To_Acceptable_Level;
  solution.cause = cause_of(status);
  solution.iterations = run.iterations;
  return solution;
}

}  // namespace

SmoothSolver ipopt_solver() {
  ipopt();
  return solve;
}

}  // namespace gainsmith::search
