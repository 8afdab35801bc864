// The claims of a method, compiled for one gain file.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hybrid/system.h"
#include "model/instance.h"

namespace gainsmith::verify {

/// A claim is stated when every symbol that its expressions use has a value; otherwise `missing`
/// names those that have none (P1 when the analysis was infeasible) and it cannot be checked.
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
/// scalar.
std::vector<CompiledClaim> compile_claims(const model::Instance& instance,
                                          const hybrid::System& system);

/// "nonincreasing", "cost", "shrinks".
std::string to_string(model::Claim::Kind kind);

}  // namespace gainsmith::verify
