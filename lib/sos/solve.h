// A program of sums of squares for the solver, and back.
//
// The Gram matrices are the dual matrix of a semidefinite program (sdp/problem.h): one equation a
// monomial, F_i . Y = c_i, Y = diag(Q_j). Unknowns without sign are put out of the equations before
// (reduce.h).
//
// Without an objective the least eigenvalue is to be largest, in whatever size the solutions have:
//   maximise t   subject to   F_i . Y = c_i s,  Y >= t I,  s >= t,  tr Y + s = N,
// N one more than the rows of Y. The solution is Y/s. Where t < 0, the multipliers exclude all
// solutions (moments.h); where t = 0, solutions are singular (face.h).
#pragma once

#include <optional>
#include <vector>

#include "base/eigen_scalars.h"
#include "numbers/matrix.h"
#include "sdp/problem.h"
#include "sdp/solution.h"
#include "sos/program.h"
#include "sos/reduce.h"

namespace gainsmith::sos {

struct Semidefinite {
  sdp::Problem problem;
  std::vector<std::size_t> equations;  ///< of each F_i; others follow from these
  bool has_margin = false;             ///< without an objective
};

/// Equations that follow from others, by their images modulo a prime, are left out. `objective`:
/// terms over elements whose sum is to be least. std::overflow_error where a number is beyond
/// double.
Semidefinite semidefinite_program(const Program& program, const Eliminated& eliminated,
                                  const std::optional<Equation>& objective = std::nullopt);

/// Values for all unknowns of a program.
struct Point {
  std::vector<numbers::Matrix> grams;
  std::vector<numbers::MatrixOf<DoubleDouble>> balanced;  ///< the same in the units of their scales
  std::vector<double> free;                               ///< u, then t
};

/// Whether equations that follow from others say the same, by their images modulo a prime.
bool agree(const Eliminated& eliminated);

/// Y/s, and u and t from the pivots in reverse order, in double. None where s is 0 (below 1e-9).
std::optional<Point> point_of(const Program& program, const Eliminated& eliminated,
                              const Semidefinite& posed, const sdp::Solution& solution);

/// t of a program without an objective, in the units of Gram::scale.
double margin_of(const sdp::Solution& solution);

}  // namespace gainsmith::sos
