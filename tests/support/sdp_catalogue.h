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
    both_infeasible,    ///< strongly: either certificate will do
    weakly_infeasible   ///< on one side: anything but "optimal" is right; a certificate must be a
                        ///< checked one
  } answer = Answer::optimum;
  double optimum = 0;
  double digits =
      7;  ///< how many the objectives must share with `optimum`, relative to max(1, |.|)
};

/// Every problem is small: m <= 12, n <= 13, so that the widest arithmetic solves it in a moment.
std::vector<CatalogueProblem> sdp_catalogue();

/// `count` of them side by side: the same answer, `count` times the optimum; and the Schur
/// complement holds one part in `count` of its entries.
CatalogueProblem copies(const CatalogueProblem& known, int count);

}  // namespace gainsmith::sdp::testing
