// The hybrid system: states, maps, the timer, signals, reports and claims.
#include "model/binding.h"

namespace gainsmith::model {

std::size_t Binding::state_of(const std::string& name) const {
  std::size_t at = 0;
  while (at < design_->states.size() && design_->states[at].name != name) ++at;
  return at;
}

std::vector<Design::MapEntry> Binding::map(const std::vector<Named>& entries) const {
  std::vector<Design::MapEntry> bound;
  for (const Named& entry : entries) {
    const std::size_t state = state_of(entry.name);
    bound.push_back(
        {state, formula(entry.value, names_->running, design_->states[state].shape), entry.place});
  }
  return bound;
}

std::vector<NamedFormula> Binding::named(const std::vector<Named>& list,
                                         const expr::Scope& scope) const {
  std::vector<NamedFormula> bound;
  for (const Named& entry : list)
    bound.push_back({entry.name, formula(entry.value, scope), entry.place});
  return bound;
}

void Binding::bind_components() {
  const expr::Scope& scope = names_->running;
  for (const Component* part : {&method().plant, &method().observer}) {
    for (const Declaration& state : part->states) {
      Design::State& bound = design_->states[state_of(state.name)];
      if (state.fallback) bound.start = formula(*state.fallback, scope, bound.shape);
    }
    named(part->outputs, scope);
    for (auto [entries, bound] :
         {std::pair{&part->flow, &design_->flow}, std::pair{&part->jump, &design_->jump}})
      for (Design::MapEntry& entry : map(*entries)) bound->push_back(std::move(entry));
  }
  design_->report = named(method().report, scope);
  design_->signals = named(method().signals, scope);
  bind_timer();
}

void Binding::bind_timer() {
  if (!method().timer) return;
  const Timer& timer = *method().timer;
  const auto end = [&](const expr::Expression& text) { return scalar(text, names_->known); };
  design_->timer = {timer.name,           end(timer.low),        end(timer.high),
                    end(timer.first_low), end(timer.first_high), timer.place};
}

void Binding::bind_claims() {
  for (const Claim& claim : method().claims)
    for (const Member& member : members(claim.indices, {}, names_->running))
      add_claim(claim, member);
}

void Binding::add_claim(const Claim& claim, const Member& member) {
  const expr::Scope& scope = names_->running;
  const auto bound = [&](const expr::Expression& part) {
    return scalar(instantiate(part, member, scope), scope);
  };
  const auto optional = [&](const std::optional<expr::Expression>& part) {
    return part ? std::optional(bound(*part)) : std::nullopt;
  };
  design_->claims.push_back({member.title_of(claim.name), claim.kind, bound(claim.value),
                             optional(claim.flow_cost), optional(claim.jump_cost),
                             optional(claim.factor), claim.place});
}

}  // namespace gainsmith::model
