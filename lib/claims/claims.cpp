#include "claims/claims.h"

#include <algorithm>

#include "base/number.h"

namespace gainsmith::claims {

namespace {

LinkedClaim link_claim(const model::Design::Claim& claim, const hybrid::System& system) {
  LinkedClaim linked;
  linked.name = claim.name;
  linked.kind = claim.kind;
  const auto link = [&](const model::Formula& formula) {
    expr::Program program = system.bodies.link(formula.program);
    for (const expr::Input& input : program.inputs) {
      auto& missing = linked.missing;
      const bool has_value = system.slot(input.name) || system.constants.contains(input.name);
      if (!has_value && std::find(missing.begin(), missing.end(), input.name) == missing.end())
        missing.push_back(input.name);
    }
    return program;
  };
  linked.value = link(claim.value);
  if (claim.flow_cost) linked.flow_cost = link(*claim.flow_cost);
  if (claim.jump_cost) linked.jump_cost = link(*claim.jump_cost);
  if (claim.factor) linked.factor = link(*claim.factor);
  if (claim.bound) linked.bound = link(*claim.bound);
  if (claim.after) link(*claim.after);
  linked.over = claim.over;
  linked.tolerance = claim.tolerance;
  if (claim.kind == model::ClaimKind::shrinks && !claim.factor)
    throw InputError(claim.place, "the claim '" + claim.name + "' has no factor");
  const bool bounded =
      claim.kind == model::ClaimKind::below || claim.kind == model::ClaimKind::above;
  if (bounded && !claim.bound)
    throw InputError(claim.place, "the claim '" + claim.name + "' has no bound");
  if (!linked.stated() || !claim.after) return linked;
  linked.after = system.scalar(*claim.after);
  if (!(linked.after >= 0))
    throw InputError(claim.after->place, "after: a time from 0 on, found " + brief(linked.after));
  return linked;
}

}  // namespace

std::vector<LinkedClaim> link_claims(const model::Design& design, const hybrid::System& system) {
  std::vector<LinkedClaim> claims;
  for (const model::Design::Claim& claim : design.claims) {
    claims.push_back(link_claim(claim, system));
    if (claim.kind == model::ClaimKind::shrinks && !model::has_end(design))
      claims.back().missing.emplace_back("campaign.horizon");
  }
  return claims;
}

void check_times(const model::Design& design, const std::vector<LinkedClaim>& claims,
                 double horizon) {
  for (std::size_t k = 0; k < claims.size(); ++k)
    if (claims[k].stated() && claims[k].after >= horizon)
      throw InputError(design.claims[k].after->place,
                       "after: the runs end at " + brief(horizon) + ", before the claim begins");
}

}  // namespace gainsmith::claims
