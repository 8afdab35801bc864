// The claims of a method, compiled for one gain file.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hybrid/system.h"
#include "model/instance.h"

namespace gainsmith::verify {

/// A claim is stated when every symbol that its expressions use has a value and, of `shrinks`, the
/// problem gives the time in which it must: how far an error shrinks says something only about a
/// time that somebody chose. Otherwise `missing` names what has no value (P1 when the analysis was
/// infeasible, campaign.horizon) and the claim cannot be checked.
struct CompiledClaim {
  std::string name;
  model::Claim::Kind kind = model::Claim::Kind::nonincreasing;
  std::vector<std::string> missing;
  expr::Program value;
  std::optional<expr::Program> flow_cost;
  std::optional<expr::Program> jump_cost;
  std::optional<expr::Program> factor;

  bool stated() const { return missing.empty(); }
};

/// All claims, in the method's order. InputError for an expression that does not compile or is no
/// scalar, and for `shrinks` without a factor.
std::vector<CompiledClaim> compile_claims(const model::Instance& instance,
                                          const hybrid::System& system);

/// "nonincreasing", "cost", "shrinks".
std::string to_string(model::Claim::Kind kind);

}  // namespace gainsmith::verify
