// Semidefinite programs with a planted optimum or certificate, in whole numbers.
//
//   minimise c'x, sum x_i F_i - F_0 = X >= 0;   maximise F_0.Y, F_i.Y = c_i, Y >= 0
//
// optimum            X = U diag(d, 0) U', Y = U^-T diag(0, e) U^-1 with U unimodular, so X Y = 0;
//                    F_0 = sum x_i F_i - X, c_i = F_i.Y: both are feasible and c'x - F_0.Y = X.Y =
//                    0, so c'x is the optimum (weak duality). F_1 > 0: the primal has an interior.
// primal infeasible  Y = U^-T diag(0, e) U^-1, F_i.Y = 0 for all i and F_0.Y > 0: any feasible x
//                    would give 0 <= X.Y = -F_0.Y.
// dual infeasible    sum x_i F_i = P >= 0 for whole x_i with c'x < 0: any feasible Y would give
//                    0 <= P.Y = c'x.
#pragma once

#include "properties/judge.h"
#include "sdp/problem.h"

namespace gainsmith::tests::properties {

struct Program {
  enum class Truth { optimum, primal_infeasible, dual_infeasible } truth = Truth::optimum;
  sdp::Problem problem;
  double optimum = 0;
};

/// Program `index` of a seed.
Program make_program(std::uint64_t seed, std::uint64_t index);

/// What the solver says: wrong are another optimum (by 1e-6 relatively, with the size of the
/// planted solutions), and a certificate where there can be none.
Answer judge(const Program& known);

}  // namespace gainsmith::tests::properties
