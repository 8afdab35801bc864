#include "bind/claims.h"

#include <utility>

#include "base/named.h"
#include "base/nearest.h"
#include "bind/estimates.h"
#include "bind/families.h"
#include "bind/formulas.h"
#include "bind/search.h"
#include "bind/simulation.h"

namespace gainsmith::bind {

namespace {

/// The texts of a claim, in order; those that it has.
std::vector<expr::Expression*> texts_of(model::Claim& claim) {
  std::vector<expr::Expression*> texts = {&claim.value};
  for (auto* part : {&claim.flow_cost, &claim.jump_cost, &claim.factor, &claim.bound, &claim.after})
    if (*part) texts.push_back(&**part);
  return texts;
}

/// The claim with the numbers of a member in all of its texts.
model::Claim instantiated(const Binding& binding, model::Claim claim, const Member& member) {
  for (expr::Expression* text : texts_of(claim))
    *text = instantiate(*text, member, binding.names->running);
  return claim;
}

/// A claim of an observer is one of each that has its names.
std::vector<std::pair<std::string, model::Claim>> readings(const Binding& binding,
                                                           model::Claim claim) {
  std::vector<expr::Expression> texts;
  for (const expr::Expression* text : texts_of(claim)) texts.push_back(*text);
  std::vector<std::pair<std::string, model::Claim>> result;
  for (const Reading& reading : binding.dynamics_names->outside(texts)) {
    const auto into = texts_of(claim);
    for (std::size_t k = 0; k < into.size(); ++k) *into[k] = reading.texts[k];
    result.emplace_back(reading.observer, claim);
  }
  return result;
}

/// A number that no run changes.
model::Formula constant_of_claim(const Binding& binding, const expr::Expression& text,
                                 const std::string& key) {
  model::Formula bound = scalar(text, binding.names->running);
  const auto changes = [&](const std::string& name) {
    if (state_of(*binding.design, name) < binding.design->states.size()) return true;
    const auto& dynamics = binding.design->dynamics;
    return dynamics && has_named(dynamics->variables, name);
  };
  for (const expr::Input& input : bound.program.inputs)
    if (changes(input.name))
      throw InputError(
          bound.place,
          key + ": '" + input.name +
              "' changes along a run; this is made of what data, parameters "
              "and gains give" +
              (key == "bound" ? "; the value comes first: {below: norm(x), bound: 2}" : ""));
  return bound;
}

/// A claim that rests on an estimate says so in its name. `over`: the event after whose jumps it is
/// made.
void add_claim(Binding& binding, const model::Claim& claim, const std::string& title,
               std::optional<std::size_t> over) {
  const expr::Scope& scope = binding.names->running;
  const auto optional = [&](const std::optional<expr::Expression>& part) {
    return part ? std::optional(scalar(*part, scope)) : std::nullopt;
  };
  model::Design::Claim bound{title,
                             claim.kind,
                             scalar(claim.value, scope),
                             optional(claim.flow_cost),
                             optional(claim.jump_cost),
                             optional(claim.factor),
                             claim.place};
  if (claim.bound) bound.bound = constant_of_claim(binding, *claim.bound, "bound");
  if (claim.after) bound.after = constant_of_claim(binding, *claim.after, "after");
  bound.over = over;
  bound.tolerance = claim.tolerance;
  bool estimated = estimate(*binding.design, bound.value.program) != expr::Estimate::none;
  for (const auto* part :
       {&bound.flow_cost, &bound.jump_cost, &bound.factor, &bound.bound, &bound.after})
    if (*part && estimate(*binding.design, (*part)->program) != expr::Estimate::none)
      estimated = true;
  if (estimated) bound.name += " (from estimates)";
  binding.design->claims.push_back(std::move(bound));
}

}  // namespace

void bind_claims(Binding& binding) {
  for (const model::Claim& claim : binding.method().claims) {
    bool bound = false;
    bool missing = false;
    for (const Member& member : members(claim.indices, {}, binding.names->running))
      for (const auto& [observer, one] : readings(binding, instantiated(binding, claim, member))) {
        std::optional<std::size_t> over;
        if (!one.over.empty()) over = find_event(binding, one.over, observer);
        missing = missing || (!one.over.empty() && !over);
        if (!one.over.empty() && !over) continue;
        const bool may_be_over = one.kind == model::ClaimKind::nonincreasing ||
                                 one.kind == model::ClaimKind::below ||
                                 one.kind == model::ClaimKind::above;
        model::Claim texts = one;
        for (const expr::Expression* text : texts_of(texts))
          check_measured(binding, *text, over, one.place,
                         may_be_over ? "; `over:` that event checks the claim just after its jumps"
                                     : "; such a claim needs values at all times");
        bound = true;
        add_claim(binding, one,
                  member.title_of(binding.dynamics_names->title(claim.name, observer)), over);
      }
    if (!bound && missing)
      throw InputError(claim.over_place,
                       "there is no event '" + claim.over + "'" +
                           suggestion(claim.over, binding.dynamics_names->event_names(nullptr)));
  }
}

}  // namespace gainsmith::bind
