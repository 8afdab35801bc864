// The claims of a method for one gain file.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hybrid/system.h"
#include "model/run_texts.h"

namespace gainsmith::claims {

/// A claim of a gain file. It is stated when every symbol that they use has a value.
/// Of `shrinks` the problem must also give a time: how far an error shrinks says something only
/// about a time that somebody chose. Otherwise `missing` names what has no value (P1 when the
/// analysis was infeasible, campaign.horizon) and the claim cannot be checked.
struct Claim {
  std::string name;
  model::ClaimKind kind = model::ClaimKind::nonincreasing;
  std::vector<std::string> missing;
  expr::Program value;
  std::optional<expr::Program> flow_cost;
  std::optional<expr::Program> jump_cost;
  std::optional<expr::Program> factor;
  std::optional<expr::Program> bound;
  double after = 0;                   ///< the time from which on it is claimed
  std::optional<std::size_t> over{};  ///< the event just after whose jumps alone it is
  double tolerance = 0;               ///< relative to the bound (claim_check.h)
  /// Of `below` and `above`: it holds wherever the states are, as a saturated input does. Its
  /// constants count as the doubles that they are.
  bool always = false;

  bool stated() const { return missing.empty(); }
};

/// Whether a claim that is made from the time `after` on is made at t. The time of a jump is a sum
/// of lengths, which rounding may leave just below the time that is meant.
bool is_after(double t, bool is_jump, double after);

/// All claims, in the method's order. InputError for `shrinks` without a factor, a bound that is
/// missing, and a time `after` that is no number from 0 on or not before the horizon.
std::vector<Claim> claims_of(const model::RunTexts& texts, const hybrid::System& system,
                             double horizon);

/// The programs of a claim: its value, and those that it has of flow cost, jump cost, factor and
/// bound, in this order.
std::vector<expr::Program> programs_of(const Claim& claim);

}  // namespace gainsmith::claims
