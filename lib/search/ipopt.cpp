#include "search/ipopt.h"

// Debian's headers of Ipopt ask which C headers there are.
#define HAVE_CSTDDEF
#include <coin/IpIpoptApplication.hpp>
#include <coin/IpSolveStatistics.hpp>
#include <coin/IpTNLP.hpp>
#undef HAVE_CSTDDEF

#include <algorithm>
#include <exception>
#include <limits>

namespace gainsmith::search {

namespace {

using Ipopt::Index;
using Ipopt::Number;

/// A SmoothProgram as Ipopt asks for it. An exception of a function ends the run and is kept.
class Adapter : public Ipopt::TNLP {
 public:
  explicit Adapter(const SmoothProgram& program) : program_(program), best_(program.start) {}

  const std::vector<double>& best() const { return best_; }
  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

  bool get_nlp_info(Index& n, Index& m, Index& nonzeros, Index& hessian,
                    IndexStyleEnum& style) override {
    n = static_cast<Index>(program_.start.size());
    m = static_cast<Index>(program_.constraints);
    nonzeros = static_cast<Index>(program_.rows.size());
    hessian = 0;
    style = C_STYLE;
    return true;
  }

  bool get_bounds_info(Index n, Number* low, Number* high, Index m, Number* c_low,
                       Number* c_high) override {
    constexpr double kIpoptInfinity = 2e19;
    for (Index i = 0; i < n; ++i) {
      low[i] = std::max(program_.low[static_cast<std::size_t>(i)], -kIpoptInfinity);
      high[i] = std::min(program_.high[static_cast<std::size_t>(i)], kIpoptInfinity);
    }
    std::fill(c_low, c_low + m, 0.0);
    std::fill(c_high, c_high + m, 0.0);
    return true;
  }

  bool get_starting_point(Index, bool, Number* v, bool, Number*, Number*, Index, bool,
                          Number*) override {
    std::copy(program_.start.begin(), program_.start.end(), v);
    return true;
  }

  bool eval_f(Index n, const Number* v, bool, Number& value) override {
    return guarded([&] { value = program_.objective(point(n, v)); });
  }

  bool eval_grad_f(Index n, const Number* v, bool, Number* gradient) override {
    return guarded([&] { copy(program_.gradient(point(n, v)), gradient); });
  }

  bool eval_g(Index n, const Number* v, bool, Index, Number* c) override {
    return guarded([&] { copy(program_.residuals(point(n, v)), c); });
  }

  bool eval_jac_g(Index n, const Number* v, bool, Index, Index, Index* rows, Index* columns,
                  Number* values) override {
    if (values != nullptr) return guarded([&] { copy(program_.jacobian(point(n, v)), values); });
    for (std::size_t k = 0; k < program_.rows.size(); ++k) {
      rows[k] = static_cast<Index>(program_.rows[k]);
      columns[k] = static_cast<Index>(program_.columns[k]);
    }
    return true;
  }

  void finalize_solution(Ipopt::SolverReturn, Index n, const Number* v, const Number*,
                         const Number*, Index, const Number*, const Number*, Number,
                         const Ipopt::IpoptData*, Ipopt::IpoptCalculatedQuantities*) override {
    best_ = point(n, v);
  }

 private:
  static std::vector<double> point(Index n, const Number* v) { return {v, v + n}; }
  static void copy(const std::vector<double>& from, Number* to) {
    std::copy(from.begin(), from.end(), to);
  }

  template <class Work>
  bool guarded(Work work) {
    try {
      work();
      return true;
    } catch (...) {
      failure_ = std::current_exception();
      return false;
    }
  }

  const SmoothProgram& program_;
  std::vector<double> best_;
  std::exception_ptr failure_;
};

std::string cause_of(Ipopt::ApplicationReturnStatus status) {
  switch (status) {
    case Ipopt::Solve_Succeeded:
      return "converged";
    case Ipopt::Solved_To_Acceptable_Level:
      return "converged to an acceptable level";
    case Ipopt::Maximum_Iterations_Exceeded:
      return "iteration limit";
    case Ipopt::Infeasible_Problem_Detected:
      return "converged to an infeasible point";
    case Ipopt::Restoration_Failed:
      return "restoration failed";
    case Ipopt::Search_Direction_Becomes_Too_Small:
      return "steps became too short";
    default:
      return "stopped with Ipopt's code " + std::to_string(static_cast<int>(status));
  }
}

}  // namespace

SmoothSolver ipopt_solver() {
  return [](const SmoothProgram& program, double tolerance, int iterations) {
    const Ipopt::SmartPtr<Ipopt::IpoptApplication> application = new Ipopt::IpoptApplication(false);
    application->Options()->SetStringValue("sb", "yes");
    application->Options()->SetIntegerValue("print_level", 0);
    application->Options()->SetStringValue("hessian_approximation", "limited-memory");
    application->Options()->SetNumericValue("tol", tolerance);
    application->Options()->SetIntegerValue("max_iter", iterations);
    SmoothSolution solution;
    // "": no options file of the working folder is read.
    if (application->Initialize("") != Ipopt::Solve_Succeeded) {
      solution.v = program.start;
      solution.cause = "Ipopt could not be started";
      return solution;
    }
    const Ipopt::SmartPtr<Adapter> adapter = new Adapter(program);
    const auto status = application->OptimizeTNLP(Ipopt::SmartPtr<Ipopt::TNLP>(GetRawPtr(adapter)));
    adapter->rethrow();
    solution.v = adapter->best();
    solution.converged =
        status == Ipopt::Solve_Succeeded || status == Ipopt::Solved_To_Acceptable_Level;
    solution.cause = cause_of(status);
    if (const auto statistics = application->Statistics(); IsValid(statistics))
      solution.iterations = statistics->IterationCount();
    return solution;
  };
}

}  // namespace gainsmith::search
