#include "verify/claims.h"

#include <algorithm>

namespace gainsmith::verify {

namespace {

LinkedClaim link_claim(const model::Design::Claim& claim, const hybrid::System& system) {
  LinkedClaim linked;
  linked.name = claim.name;
  linked.kind = claim.kind;
  const auto link = [&](const model::Formula& formula) {
    expr::Program program = system.link(formula);
    for (const std::string& name : system.missing(program))
      if (std::find(linked.missing.begin(), linked.missing.end(), name) == linked.missing.end())
        linked.missing.push_back(name);
    return program;
  };
  linked.value = link(claim.value);
  if (claim.flow_cost) linked.flow_cost = link(*claim.flow_cost);
  if (claim.jump_cost) linked.jump_cost = link(*claim.jump_cost);
  if (claim.factor) linked.factor = link(*claim.factor);
  if (claim.kind == model::ClaimKind::shrinks && !claim.factor)
    throw InputError(claim.place, "the claim '" + claim.name + "' has no factor");
  return linked;
}

}  // namespace

std::vector<LinkedClaim> link_claims(const model::Design& design, const hybrid::System& system) {
  std::vector<LinkedClaim> claims;
  for (const model::Design::Claim& claim : design.claims) {
    claims.push_back(link_claim(claim, system));
    if (claim.kind == model::ClaimKind::shrinks && !design.campaign.horizon)
      claims.back().missing.emplace_back("campaign.horizon");
  }
  return claims;
}

}  // namespace gainsmith::verify
