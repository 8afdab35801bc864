#include "sdp/solution.h"

#include <algorithm>
#include <cmath>

namespace gainsmith::sdp {

std::string to_string(Status status) {
  switch (status) {
    case Status::optimal:
      return "optimal";
    case Status::primal_infeasible:
      return "primal-infeasible";
    case Status::dual_infeasible:
      return "dual-infeasible";
    case Status::undecided:
      return "undecided";
  }
  return "undecided";
}

std::string to_string(Cause cause) {
  switch (cause) {
    case Cause::converged:
      return "converged";
    case Cause::certificate:
      return "certificate";
    case Cause::enough:
      return "enough";
    case Cause::iteration_limit:
      return "iteration-limit";
    case Cause::interrupted:
      return "interrupted";
    case Cause::stalled:
      return "stalled";
    case Cause::numerical_breakdown:
      return "numerical-breakdown";
  }
  return "numerical-breakdown";
}

double worst(const Solution& solution) {
  double result = 0;
  for (const double error : solution.dimacs) result = std::max(result, std::abs(error));
  return result;
}

}  // namespace gainsmith::sdp
