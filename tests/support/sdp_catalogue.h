// Semidefinite programs whose optimum or infeasibility is known by construction.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sdp/problem.h"

namespace gainsmith::sdp::testing {

struct CatalogueProblem {
  std::string name;
  Problem problem;
  enum class Answer {
    optimum,            ///< attained or not: both objectives tend to `optimum`
    primal_infeasible,  ///< strongly: a certificate exists
    dual_infeasible,    ///< strongly
    weakly_infeasible   ///< anything but "optimal" is right; a certificate must be a checked one
  } answer = Answer::optimum;
  double optimum = 0;
  double digits =
      7;  ///< how many the objectives must share with `optimum`, relative to max(1, |.|)
};

/// Every problem is small: m <= 12, n <= 12, so that the widest arithmetic solves it in a moment.
std::vector<CatalogueProblem> sdp_catalogue();

}  // namespace gainsmith::sdp::testing
