#include "bind/observer_families.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "bind/binding.h"
#include "bind/families.h"

namespace gainsmith::bind {

namespace {

/// Puts the numbers of a member into all texts of an observer.
/// A copy of an observer with numbers in place of the indices, in every text that it has.
class Instantiation {
 public:
  Instantiation(const Member& member, const expr::Scope& scope) : member_(member), scope_(scope) {}

  model::Component operator()(model::Component observer) const {
    observer.name = member_.name_of(observer.name);
    observer.indices.clear();
    for (auto* list : {&observer.states, &observer.modes})
      for (model::Declaration& state : *list) put(state.fallback);
    for (model::Output& output : observer.outputs) put(output.value);
    put(observer.let);
    put(observer.flow);
    put(observer.jump);
    for (model::EventText& event : observer.events) put(event);
    for (model::ReactionText& reaction : observer.at)
      for (model::PassText& pass : reaction.passes) put(pass);
    put(observer.frozen);
    for (model::FlowSetText& flow_set : observer.flow_sets) put(flow_set.condition);
    return observer;
  }

 private:
  void put(expr::Expression& text) const { text = instantiate(text, member_, scope_); }
  void put(std::optional<expr::Expression>& text) const {
    if (text) put(*text);
  }
  void put(std::vector<expr::Expression>& texts) const {
    for (expr::Expression& text : texts) put(text);
  }
  void put(std::vector<model::Named>& entries) const {
    for (model::Named& entry : entries) put(entry.value);
  }
  /// An argument of a definition keeps the name of an index to itself.
  void put(std::vector<model::Let>& entries) const {
    for (model::Let& let : entries) {
      Member others = member_;
      for (const std::string& parameter : let.signature.parameters) others.indices.erase(parameter);
      let.body = instantiate(let.body, others, scope_);
    }
  }
  void put(model::EventText& event) const {
    put(event.what);
    put(event.numbers);
    put(event.first);
    put(event.only_if);
  }
  void put(model::PassText& pass) const {
    put(pass.let);
    put(pass.map);
    put(pass.until);
    put(pass.at_most);
  }

  const Member& member_;
  const expr::Scope& scope_;
};

}  // namespace

/// The method is copied, as other problems may share it.
void bind_observer_families(Binding& binding) {
  const std::vector<model::Component>& observers = binding.method().observers;
  if (std::ranges::all_of(observers, [](const auto& one) { return one.indices.empty(); })) return;
  const expr::Scope& scope = binding.names->known;
  auto method = std::make_shared<model::Method>(binding.method());
  method->observers.clear();
  for (const model::Component& observer : observers) {
    ranges(observer.indices, scope);
    for (const Member& member : members(observer.indices, {}, scope))
      method->observers.push_back(Instantiation(member, scope)(observer));
  }
  auto problem = std::make_shared<model::Problem>(binding.problem());
  problem->method = std::move(method);
  binding.source = std::move(problem);
}

}  // namespace gainsmith::bind
