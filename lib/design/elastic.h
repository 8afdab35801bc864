// How far a problem is from having a solution: its inequalities with slacks. And the problem with
// less in it, as a problem of its own that takes the same path to the solver.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "model/instance.h"
#include "model/words.h"
#include "sdp/solver.h"

namespace gainsmith::design {

/// Without gains (and so without bounds on them), nothing searched or expected.
model::Instance without_gains(const model::Instance& instance);

/// Without its objective: any solution will do.
model::Instance without_objective(const model::Instance& instance);

/// Without gains, and its objective, at most `value`, as an inequality.
model::Instance with_objective_below(const model::Instance& instance, double value);

/// With the inequalities named, the others left out.
model::Instance with_inequalities(const model::Instance& instance,
                                  const std::set<std::string>& names);

/// A number for each inequality named.
using ByInequality = std::map<std::string, double>;

/// For each inequality named the diagonal of a matrix: one number for a multiple of I.
using Diagonals = std::map<std::string, std::vector<double>>;

/// The sizes of the rows of each inequality: s_kr^-2 of the balance (lmi/balance.h), the largest of
/// its comparisons and points.
Diagonals row_scales_of(const model::Instance& instance);

/// The largest of them.
ByInequality scales_of(const model::Instance& instance);

/// Every inequality k of `scales` relaxed by an unknown slack t_k >= 0,
///     a < b   becomes   a < b + t_k diag(s_k)
/// (each comparison of a chain), and minimize: the sum of the slacks. Where nothing has a constant
/// part, strict inequalities, relaxed or not, have to hold with room D_k before the slack, their
/// row_scales_of: a + D_k < b + t_k diag(s_k). So t_k = 1 gives all of it up. `slacks` receives the
/// names of the unknowns t_k by inequality.
model::Instance elastic(const model::Instance& instance, const Diagonals& scales,
                        std::map<std::string, std::string>& slacks);

/// Slacks when the verdict is yes; no when a certificate excludes the elastic problem too.
struct Slacks {
  model::Verdict verdict = model::Verdict::undecided;
  bool smallest = false;  ///< otherwise these are enough, and fewer may be
  ByInequality by_inequality;
};

/// The slacks of the elastic problem with the smallest sum. One below 1e-7 counts as 0.
Slacks smallest_slacks(const model::Instance& instance, const ByInequality& scales,
                       const sdp::Options& solver);

/// About the smallest sum of slacks, at the first points of each domain, in double and unchecked: a
/// guide for searches, which does not depend on units. None where the solver comes to nothing.
/// Of no use as a proof.
std::optional<double> estimated_violation(const model::Instance& instance, const Diagonals& scales,
                                          const sdp::Options& solver);

}  // namespace gainsmith::design
