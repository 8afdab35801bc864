// Claims: of each member of a family, and of each observer that has their names.
#include <algorithm>
#include <utility>

#include "base/nearest.h"
#include "bind/binding.h"

namespace gainsmith::bind {

namespace {

/// The texts of a claim, in order; those that it has.
std::vector<expr::Expression*> texts_of(model::Claim& claim) {
  std::vector<expr::Expression*> texts = {&claim.value};
  for (auto* part : {&claim.flow_cost, &claim.jump_cost, &claim.factor, &claim.bound, &claim.after})
    if (*part) texts.push_back(&**part);
  return texts;
}

}  // namespace

void Binding::bind_claims() {
  for (const model::Claim& claim : method().claims) {
    bool bound = false;
    bool missing = false;
    for (const Member& member : members(claim.indices, {}, names_->running))
      for (const auto& [observer, one] : readings(instantiated(claim, member))) {
        std::optional<std::size_t> over;
        if (!one.over.empty()) over = find_event(one.over, observer);
        missing = missing || (!one.over.empty() && !over);
        if (!one.over.empty() && !over) continue;
        bound = true;
        add_claim(one, member.title_of(dynamics_names_->title(claim.name, observer)), over);
      }
    if (!bound && missing)
      throw InputError(claim.over_place,
                       "there is no event '" + claim.over + "'" +
                           suggestion(claim.over, dynamics_names_->event_names(nullptr)));
  }
}

model::Claim Binding::instantiated(model::Claim claim, const Member& member) const {
  for (expr::Expression* text : texts_of(claim))
    *text = instantiate(*text, member, names_->running);
  return claim;
}

/// A claim of an observer is one of each that has its names.
std::vector<std::pair<std::string, model::Claim>> Binding::readings(model::Claim claim) const {
  std::vector<expr::Expression> texts;
  for (const expr::Expression* text : texts_of(claim)) texts.push_back(*text);
  std::vector<std::pair<std::string, model::Claim>> result;
  for (const Reading& reading : dynamics_names_->outside(texts)) {
    const auto into = texts_of(claim);
    for (std::size_t k = 0; k < into.size(); ++k) *into[k] = reading.texts[k];
    result.emplace_back(reading.observer, claim);
  }
  return result;
}

/// A number that no run changes.
model::Formula Binding::constant_of_claim(const expr::Expression& text,
                                          const std::string& key) const {
  model::Formula bound = scalar(text, names_->running);
  const auto changes = [&](const std::string& name) {
    if (state_of(name) < design_->states.size()) return true;
    const auto& dynamics = design_->dynamics;
    return dynamics && std::any_of(dynamics->variables.begin(), dynamics->variables.end(),
                                   [&](const auto& one) { return one.name == name; });
  };
  for (const expr::Input& input : bound.program.inputs)
    if (changes(input.name))
      throw InputError(bound.place, key + ": '" + input.name +
                                        "' changes along a run; here stands what data, parameters "
                                        "and gains give");
  return bound;
}

void Binding::add_claim(const model::Claim& claim, const std::string& title,
                        std::optional<std::size_t> over) {
  const expr::Scope& scope = names_->running;
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
  if (claim.bound) bound.bound = constant_of_claim(*claim.bound, "bound");
  if (claim.after) bound.after = constant_of_claim(*claim.after, "after");
  bound.over = over;
  bool estimated = estimate(bound.value.program) != expr::Estimate::none;
  for (const auto* part :
       {&bound.flow_cost, &bound.jump_cost, &bound.factor, &bound.bound, &bound.after})
    if (*part && estimate((*part)->program) != expr::Estimate::none) estimated = true;
  if (estimated) bound.name += " (from estimates)";
  design_->claims.push_back(std::move(bound));
}

}  // namespace gainsmith::bind
