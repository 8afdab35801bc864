// How far a problem is from having a solution: its requirements with slacks.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "model/instance.h"
#include "model/words.h"
#include "sdp/solver.h"

namespace gainsmith::design {

/// A number for each requirement named.
using ByRequirement = std::map<std::string, double>;

/// The scale of each requirement, as its margins are measured (docs/conventions.md).
ByRequirement scales_of(const model::Problem& problem, const model::Overrides& overrides);

/// The problem with every requirement k of `scales` relaxed by an unknown slack t_k >= 0,
///   a < b   becomes   a < b + t_k s_k I
/// (each comparison of a chain), and minimize: the sum of the slacks. `slacks` receives the names
/// of the unknowns t_k by requirement.
model::Problem elastic(model::Problem problem, const ByRequirement& scales,
                       std::map<std::string, std::string>& slacks);

/// Slacks when the verdict is yes; no when also the elastic problem is proved infeasible.
struct Slacks {
  model::Verdict verdict = model::Verdict::undecided;
  ByRequirement by_requirement;
};

/// The slacks of the elastic problem with the smallest sum. One below the margin counts as 0.
Slacks smallest_slacks(const model::Problem& problem, const ByRequirement& scales,
                       const model::Overrides& overrides, const sdp::Options& solver);

}  // namespace gainsmith::design
