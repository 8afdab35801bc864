// What a solve found: why it stopped, how good the point is, and the certificate when there is
// none.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/finer.h"

namespace gainsmith::sdp {

/// What is known. `optimal`: both objectives agree to the tolerance and the errors recomputed on
/// the unscaled problem are below it; it does not say that the true optimum is attained.
/// `primal_infeasible`, `dual_infeasible`: a certificate was recomputed from the raw data, in
/// floating point, and passed its check; it excludes solutions up to a size, no more (Certificate).
/// `undecided`: none of these, whatever the point looks like.
enum class Status { optimal, primal_infeasible, dual_infeasible, undecided };

/// Why the iteration stopped; never mixed with the quality of the point.
enum class Cause {
  converged,    ///< the stopping test held
  certificate,  ///< an infeasibility certificate passed its check
  enough,       ///< the caller had enough (Options::enough)
  iteration_limit,
  interrupted,         ///< by a stop (base/stop.h)
  stalled,             ///< steps became too short or progress ended short of the tolerance
  numerical_breakdown  ///< a factorisation failed beyond repair
};

/// "optimal", "primal-infeasible", ...; "converged", "iteration-limit", ...
std::string to_string(Status status);
std::string to_string(Cause cause);

/// A symmetric block-diagonal matrix: values[b] is size x size column-major for a dense block,
/// `size` diagonal entries for a diagonal block.
struct BlockMatrix {
  std::vector<std::vector<double>> values;
};

/// A Farkas certificate as it was checked, from the raw data in the arithmetic of the point. A
/// matrix counts as >= -e I when M + e I has a Cholesky factor there, e = 0 or a power of two.
/// Primal infeasible: Y >= 0 with F_0.Y = 1 (normalised) and r_i = F_i.Y nearly 0. Any feasible x
/// has sum_i r_i x_i = X.Y + F_0.Y >= 1, so every x with max|x_i| < 1 / sum|r_i| is excluded.
/// Dual infeasible: x with c'x = -1 (normalised) and sum_i x_i F_i >= -e I nearly >= 0. Any
/// feasible Y has -1 = sum_i x_i F_i . Y >= -e trace(Y), so every Y with trace(Y) < 1/e is
/// excluded.
struct Certificate {
  double value = 0;            ///< F_0.Y, or -c'x, after normalisation: 1
  double residual = 0;         ///< sum_i |F_i.Y|, or e
  double min_eigenvalue = 0;   ///< of Y (all blocks), or of sum_i x_i F_i; -e where negative
  double excluded_radius = 0;  ///< no solution smaller than this: 1/residual
  bool checked = false;
};

struct Solution {
  Status status = Status::undecided;
  Cause cause = Cause::numerical_breakdown;
  std::string message;  ///< one sentence for a person, when undecided

  std::vector<double> x;  ///< m; of the best point, or of the certificate; none before a point
  BlockMatrix X;          ///< sum x_i F_i - F_0 as iterated
  BlockMatrix Y;

  /// The point in a wider arithmetic than double is x + rest.x, X + rest.X, Y + rest.Y (empty in
  /// double). The measures below are those of that point: problems that need the digits have
  /// solutions of such a norm that rounding alone may cost them.
  struct Rest {
    std::vector<double> x;
    BlockMatrix X;
    BlockMatrix Y;
    std::vector<std::vector<Finer>> finer_Y;  ///< of each element; empty but in 100 digits
  } rest;

  double primal_objective = 0;  ///< c'x, recomputed from the raw data
  double dual_objective = 0;    ///< F_0.Y, recomputed from the raw data
  double relative_gap = 0;      ///< (primal - dual) / (1 + |primal| + |dual|)
  /// The six DIMACS errors (Mittelmann 2003), recomputed on the unscaled problem:
  ///   1  ||F_i.Y - c_i|| / (1 + max|c|)
  ///   2  max(0, -lambda_min(Y)) / (1 + max|c|)
  ///   3  ||sum x_i F_i - F_0 - X||_F / (1 + max|F_0|)
  ///   4  max(0, -lambda_min(X)) / (1 + max|F_0|)
  ///   5  relative_gap, with its sign
  ///   6  X.Y / (1 + |primal| + |dual|)
  /// with the eigenvalues of 2 and 4 rounded up to a power of two.
  std::array<double, 6> dimacs{};
  Certificate certificate;

  int iterations = 0;
  std::string precision = "double";  ///< the widest type that was needed
  std::string precision_reason;      ///< why, when wider than double
  double seconds = 0;                ///< wall time; never part of a result that must repeat
};

/// The worst of the DIMACS errors.
double worst(const Solution& solution);

}  // namespace gainsmith::sdp
