// What the optimisation libraries do for gainsmith, as functions. The libraries are loaded by the
// search that needs them (docs/decisions/0057-one-program.md).
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace gainsmith::search {

/// What the message says where a library is not there.
inline constexpr const char* kNeedsOptimizers =
    "a search over scalars ('search' with 'over', optimize) needs NLopt and Ipopt, and verify "
    "--worst needs NLopt. Scalars that have a value under 'data' or 'parameters' are not searched";

/// A search without derivatives in the unit box [0, 1]^d.
struct LocalSearchOptions {
  double step = 0.1;             ///< the first steps, in each coordinate
  double tolerance = 1e-5;       ///< of the point
  int evaluations = 100;         ///< at most
  std::optional<double> target;  ///< stop at the first value at or below it
};

/// Calls `function` (finite values) at points of the box; the caller keeps the best. Returning
/// false from `go_on`, asked before each evaluation, ends the search.
using LocalSearch =
    std::function<void(const std::function<double(const std::vector<double>&)>& function,
                       const std::vector<double>& start, const LocalSearchOptions& options,
                       const std::function<bool()>& go_on)>;

/// A smooth program: minimise f(v) subject to c(v) = 0, low <= v <= high. Derivatives are the
/// caller's.
struct SmoothProgram {
  std::vector<double> start;
  std::vector<double> low;   ///< -infinity: none
  std::vector<double> high;  ///< infinity: none
  std::size_t constraints = 0;
  std::function<double(const std::vector<double>& v)> objective;
  std::function<std::vector<double>(const std::vector<double>& v)> gradient;
  std::function<std::vector<double>(const std::vector<double>& v)> residuals;  ///< c(v)
  /// The places of the Jacobian's elements that may be nonzero, and their values in that order.
  std::vector<std::size_t> rows;
  std::vector<std::size_t> columns;
  std::function<std::vector<double>(const std::vector<double>& v)> jacobian;
};

struct SmoothSolution {
  std::vector<double> v;
  bool converged = false;
  std::string cause;  ///< in the words of the library
  int iterations = 0;
};

using SmoothSolver =
    std::function<SmoothSolution(const SmoothProgram& program, double tolerance, int iterations)>;

}  // namespace gainsmith::search
