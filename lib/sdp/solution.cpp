#include "sdp/solution.h"

#include <algorithm>
#include <cmath>

#include "base/words.h"

namespace gainsmith::sdp {

std::string to_string(Status status) {
  return word_of<Status::undecided>(
      status, {"optimal", "primal-infeasible", "dual-infeasible", "undecided"});
}

std::string to_string(Cause cause) {
  return word_of<Cause::numerical_breakdown>(
      cause, {"converged", "certificate", "enough", "iteration-limit", "interrupted", "stalled",
              "numerical-breakdown"});
}

double worst(const Solution& solution) {
  double result = 0;
  for (const double error : solution.dimacs) result = std::max(result, std::abs(error));
  return result;
}

}  // namespace gainsmith::sdp
