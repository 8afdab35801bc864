// From affine blocks to a semidefinite program that means what an engineer asks, and back.
//
// Everything is solved in balanced units (balance.h): B_k(x) below is S_k B_k(x) S_k in x_i / d_i,
// so what comes out does not depend on the units of the problem.
//
//   objective   minimise c'x + weight sum_k tr(B_k(x)),  B_k(x) >= shift I, strict or not; gain
//               bounds >= 0; in units of the data without weight, and again in units of the
//               solution where these are far from the first (in_units_of_solution). The weight
//               bounds what the objective does not depend on.
//   interior    the largest unit-free margin, min over k of the smallest eigenvalue of
//               D^-1/2 B_k(x) D^-1/2 with D = diag(B_k(x)), of the homogenised blocks
//                 x_0 B_k0 + sum_i x_i B_ki > 0,   x_0 > 0  (where a block has a constant part):
//                 maximise s,  B_k(x) - t diag(B_k(x)) >= s D_k,  x_0 (1 - t) >= s D_0,
//                              sum_k tr(D_k^-1 B_k(x)) + x_0 / D_0 <= N, the number of rows
//               begun with t = 0, D_k = I and repeated with t the margin found and D_k =
//               diag(B_k(x)): t rises to the largest margin. The program always has a solution, s
//               >= 0. With s > 0 x / x_0 satisfies every inequality strictly; with s = 0 the dual
//               solution is a certificate that none does (verdict/refutation.h).
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "lmi/assembler.h"
#include "lmi/balance.h"
#include "lmi/compile.h"
#include "lmi/free_variables.h"
#include "lmi/gain_bounds.h"
#include "sdp/problem.h"
#include "sdp/solution.h"

namespace gainsmith::lmi {

/// A minimum, or the largest margin, as above.
enum class Goal { objective, interior };

/// Where a round of `interior` begins.
struct Round {
  double margin = 0;                       ///< t
  std::vector<numbers::Vector> diagonals;  ///< D_k of all blocks, bounds included; empty: I
  double constant = 1;                     ///< D_0
};

struct Formulation {
  Goal goal = Goal::objective;
  Balance balance;               ///< of the blocks of the Lmi, then of the gain bounds
  double shift = 0;              ///< objective
  bool only_strict = false;      ///< objective: blocks with >= are shifted by nothing
  double weight = 0;             ///< objective
  double cost_unit = 1;          ///< objective: costs of the problem by those of the Lmi, 2^k
  bool homogenised = false;      ///< interior: x_0 comes before s, which is the last variable
  int rows = 0;                  ///< interior: N
  int variables = 0;             ///< of the program
  FreeVariables free_variables;  ///< scalars left out, and the rows of each block that stay
  std::vector<int> sizes;        ///< rows that stay in each block, those of the bounds last

  // Of what is assembled:
  sdp::Problem problem;               ///< its first blocks are those of the Lmi, then of the bounds
  std::vector<BalancedBlock> blocks;  ///< as solved, those of the bounds last
};

/// Exact coefficients of a block in place of those in double.
using Exactly = std::function<BalancedBlock(std::size_t block, const Balance& balance,
                                            const std::vector<int>& kept)>;

/// Whether the Lmi asks for an objective that can have a minimum: without constant parts x may be
/// scaled, and the infimum is 0 or there is none.
bool has_minimum(const Lmi& lmi, const GainBounds& bounds);

/// Without the program, which not every solver wants (matrix_program.h).
Formulation pose_objective(const Lmi& lmi, const GainBounds& bounds, double shift);
Formulation pose_interior(const Lmi& lmi, const GainBounds& bounds);

/// Adds the program. With `exactly` the coefficients of the Lmi's blocks are those, in 31 digits;
/// there must be no bounds then. `round`: of an interior formulation.
void assemble(const Lmi& lmi, const GainBounds& bounds, const Round& round,
              Formulation& formulation, const Exactly& exactly = {});

/// Both steps.
Formulation formulate_objective(const Lmi& lmi, const GainBounds& bounds, double shift);
Formulation formulate_interior(const Lmi& lmi, const GainBounds& bounds, const Round& round,
                               const Exactly& exactly = {});

/// The least violation of the inequalities as given, which have constant parts:
///   maximise s,  B_k(x) >= s I
/// without gain bounds; s is the last variable. Where s < 0 its multipliers are a certificate of
/// small rank, and x a solution of B_k(x) >= s I beside them: both are of an ordinary size where
/// the homogenised inequalities have no solution but 0.
Formulation formulate_violation(const Lmi& lmi);

/// s of an interior solution, in balanced units: > 0 where x / x_0 is strictly inside.
double interior_margin(const sdp::Solution& solution);

/// The scalars x of the Lmi from the solution (the program has more variables), free ones
/// restored; of an interior solution x / x_0.
std::vector<double> read_back(const Lmi& lmi, const Formulation& formulation,
                              const sdp::Solution& solution);

/// The round after the solution x of an interior program; none when a block has a diagonal element
/// <= 0 there.
std::optional<Round> next_round(const Lmi& lmi, const GainBounds& bounds,
                                const Formulation& formulation, const std::vector<double>& x);

/// The same objective in units of a solution x: rows of blocks in which the terms of their
/// diagonals, sum_i |x_i B_ki|, are near 1, and unknowns whose largest coefficient is near 1.
/// Without the program.
Formulation in_units_of_solution(const Lmi& lmi, const GainBounds& bounds,
                                 const Formulation& formulation, const std::vector<double>& x);

/// Whether an optimum between these values of the objective is known to 1e-6 of its size, or to be
/// 0 within 1e-8 of the unit of the costs.
bool is_narrow_bracket(double low, double high, const Formulation& formulation);

/// An estimate, which nothing shows (verdict/weak_duality.h), of a lower bound on the objective
/// without margins, by weak duality with the dual solution Y,
///   c'x >= r_0 + sum_i r_i x_i - w sum_k tr(B_k(x)),
///   r_i = c_i + w sum_k tr(B_ki) - sum_k <B_ki, Y_k>,   c_0 = 0,  w the weight,
/// for every x that satisfies the inequalities and is like the solution: no |x_i| is more than
/// twice as large, nor the trace of the blocks more than 30 times.
double objective_lower_bound(const Lmi& lmi, const GainBounds& bounds,
                             const Formulation& formulation, const sdp::Solution& solution);

/// The multiplier of a block of the Lmi, or of the bounds behind them, in the units of the data, of
/// its rows that were solved: <B_ki, Y_k> is the same number in both units.
numbers::Matrix in_data_units(const Lmi& lmi, const GainBounds& bounds,
                              const Formulation& formulation, std::size_t k,
                              const Eigen::Ref<const numbers::Matrix>& y);

/// The multipliers Y_k of a dual solution in the units of the data, for the blocks of the Lmi and
/// then of the bounds.
std::vector<numbers::Matrix> multipliers(const Lmi& lmi, const GainBounds& bounds,
                                         const Formulation& formulation,
                                         const sdp::Solution& solution);

/// tr(Y) of an inequality at each of its points, over all its comparisons and vertices of
/// polytopes, in balanced units.
std::vector<double> multiplier_sizes(const Lmi& lmi, const Formulation& formulation,
                                     const sdp::Solution& solution, const std::string& inequality,
                                     std::size_t points);

}  // namespace gainsmith::lmi
