#include "verify/claims.h"

#include <algorithm>

#include "expr/compile.h"

namespace gainsmith::verify {

namespace {

CompiledClaim compile_claim(const model::Claim& claim, const hybrid::System& system) {
  CompiledClaim compiled;
  compiled.name = claim.name;
  compiled.kind = claim.kind;
  const auto scalar = [&](const expr::Expression& expression) {
    expr::Program program = expr::compile(expression, system.scope, expr::Shape{1, 1});
    for (const std::string& name : hybrid::missing_values(program, system.layout, system.constants))
      if (std::find(compiled.missing.begin(), compiled.missing.end(), name) ==
          compiled.missing.end())
        compiled.missing.push_back(name);
    return program;
  };
  compiled.value = scalar(claim.value);
  if (claim.flow_cost) compiled.flow_cost = scalar(*claim.flow_cost);
  if (claim.jump_cost) compiled.jump_cost = scalar(*claim.jump_cost);
  if (claim.factor) compiled.factor = scalar(*claim.factor);
  if (claim.kind == model::Claim::Kind::shrinks && !claim.factor)
    throw InputError(claim.place, "the claim '" + claim.name + "' has no factor");
  return compiled;
}

}  // namespace

std::vector<CompiledClaim> compile_claims(const model::Instance& instance,
                                          const hybrid::System& system) {
  std::vector<CompiledClaim> claims;
  for (const model::Claim& claim : instance.method->claims) {
    claims.push_back(compile_claim(claim, system));
    // How far an error shrinks says something only about a time that somebody chose.
    if (claim.kind == model::Claim::Kind::shrinks && !instance.problem->campaign.horizon)
      claims.back().missing.emplace_back("campaign.horizon");
  }
  return claims;
}

std::string to_string(model::Claim::Kind kind) {
  switch (kind) {
    case model::Claim::Kind::nonincreasing:
      return "nonincreasing";
    case model::Claim::Kind::cost:
      return "cost";
    case model::Claim::Kind::shrinks:
      return "shrinks";
  }
  return "?";
}

}  // namespace gainsmith::verify
