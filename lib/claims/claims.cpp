#include "claims/claims.h"

#include <algorithm>

#include "base/number.h"
#include "hybrid/event_functions.h"
#include "hybrid/tolerances.h"

namespace gainsmith::claims {

namespace {

using model::ClaimKind;

/// Adds the names that a formula uses and that have no value.
void add_missing(const model::Formula& formula, const hybrid::System& system,
                 std::vector<std::string>& missing) {
  for (const expr::Input& input : formula.program.inputs) {
    const bool has_value = system.slot(input.name) || system.constants.contains(input.name);
    if (!has_value && std::ranges::find(missing, input.name) == missing.end())
      missing.push_back(input.name);
  }
}

/// The programs of one claim, and the names without a value.
Claim claim_of(const model::Design::Claim& claim, const hybrid::System& system) {
  Claim made;
  made.name = claim.name;
  made.kind = claim.kind;
  made.over = claim.over;
  made.tolerance = claim.tolerance;
  add_missing(claim.value, system, made.missing);
  made.value = claim.value.program;
  const auto take = [&](const std::optional<model::Formula>& formula) {
    if (formula) add_missing(*formula, system, made.missing);
    return formula ? std::optional(formula->program) : std::nullopt;
  };
  made.flow_cost = take(claim.flow_cost);
  made.jump_cost = take(claim.jump_cost);
  made.factor = take(claim.factor);
  made.bound = take(claim.bound);
  take(claim.after);
  if (claim.kind == ClaimKind::shrinks && !claim.factor)
    throw InputError(claim.place, "the claim '" + claim.name + "' has no factor");
  const bool bounded = claim.kind == ClaimKind::below || claim.kind == ClaimKind::above;
  if (bounded && !claim.bound)
    throw InputError(claim.place, "the claim '" + claim.name + "' has no bound");
  return made;
}

/// By intervals, in which a run without an escape has its variables.
bool always_holds(const Claim& claim, const hybrid::System& system) {
  if (!claim.stated() || !claim.bound || claim.value.shape().size() != 1) return false;
  constexpr numbers::Range any = {-hybrid::kLargestState, hybrid::kLargestState};
  numbers::StackedFunctions both = hybrid::stacked({&claim.value, &*claim.bound}, system);
  if (!both.enclose(numbers::Box(static_cast<std::size_t>(system.whole), any))) return false;
  const numbers::Range& value = both.range(0, 0);
  const numbers::Range& bound = both.range(1, 0);
  return claim.kind == ClaimKind::above ? value.low >= bound.high : value.high <= bound.low;
}

/// A time in [0, horizon).
double after_of(const model::Formula& after, const hybrid::System& system, double horizon) {
  const double t = system.scalar(after);
  if (!(t >= 0)) throw InputError(after.place, "after: a time from 0 on, found " + brief(t));
  if (t >= horizon)
    throw InputError(after.place,
                     "after: the runs end at " + brief(horizon) + ", before the claim begins");
  return t;
}

}  // namespace

bool is_after(double t, bool is_jump, double after) {
  return t >= (is_jump ? (1 - hybrid::kAddedUp) * after : after);
}

std::vector<Claim> claims_of(const model::RunTexts& texts, const hybrid::System& system,
                             double horizon) {
  const bool has_end = texts.campaign.horizon || !texts.dynamics.measured.empty();
  std::vector<Claim> claims;
  for (const model::Design::Claim& claim : texts.claims) {
    Claim& made = claims.emplace_back(claim_of(claim, system));
    if (claim.kind == ClaimKind::shrinks && !has_end) made.missing.emplace_back("campaign.horizon");
    made.always = always_holds(made, system);
    if (made.stated() && claim.after) made.after = after_of(*claim.after, system, horizon);
  }
  return claims;
}

std::vector<expr::Program> programs_of(const Claim& claim) {
  std::vector<expr::Program> programs{claim.value};
  for (const auto* part : {&claim.flow_cost, &claim.jump_cost, &claim.factor, &claim.bound})
    if (*part) programs.push_back(**part);
  return programs;
}

}  // namespace gainsmith::claims
