#include "bind/dynamics_names.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "base/named.h"
#include "base/nearest.h"

namespace gainsmith::bind {

namespace {

constexpr std::string_view kPlantName = "plant";
constexpr std::string_view kPlant = "plant.";
constexpr std::string_view kLeft = ".left";

}  // namespace

std::string full_name(const model::Component& component, const std::string& name) {
  return component.name == kPlantName ? name : component.name + "." + name;
}

std::set<std::string> names_of(const model::Component& component) {
  std::set<std::string> names;
  for (const auto* list : {&component.states, &component.modes})
    for (const model::Declaration& state : *list) names.insert(state.name);
  for (const model::Output& output : component.outputs) names.insert(output.name);
  for (const model::Let& let : component.let) names.insert(let.signature.name);
  return names;
}

namespace {

/// The names that the plant hides within its own texts.
std::set<std::string> names_of_method(const model::Method& method) {
  std::set<std::string> names;
  for (const model::Declaration& datum : method.data) names.insert(datum.name);
  for (const model::Parameter& parameter : method.parameters) names.insert(parameter.name);
  for (const model::UnknownDeclaration& unknown : method.unknowns) names.insert(unknown.name);
  for (const model::Let& let : method.let) names.insert(let.signature.name);
  for (const model::Gain& gain : method.gains) names.insert(gain.name);
  return names;
}

}  // namespace

/// Names are sorted by who has them: the method, plant and method both, each observer, or no
/// observer.
DynamicsNames::DynamicsNames(const model::Method& method, std::set<std::string> varied)
    : method_(&method), varied_(std::move(varied)), of_method_(names_of_method(method)) {
  for (const std::string& name : names_of(method.plant))
    if (of_method_.contains(name)) shared_.insert(name);
  for (const model::Component& observer : method.observers)
    own_[observer.name] = names_of(observer);
  anywhere_ = names_of(method.plant);
  for (const model::Named& input : method.inputs) anywhere_.insert(input.name);
  for (const model::MeasuredText& input : method.measured) anywhere_.insert(input.name);
  for (const model::NoiseText& noise : method.noise) anywhere_.insert(noise.name);
}

std::string DynamicsNames::full(const model::Component& component, const std::string& name) const {
  const bool shared = component.name == kPlantName && shared_.contains(name);
  return shared ? std::string(kPlant) + name : full_name(component, name);
}

bool DynamicsNames::is_output_of_plant(const std::string& name) const {
  const auto& outputs = method_->plant.outputs;
  return has_named(outputs, name);
}

/// "plant.x" is x, "plant.impact.left" is impact.left; what has a value under "plant.x" stays.
std::optional<std::string> DynamicsNames::of_part(const std::string& name) const {
  if (!name.starts_with(kPlant)) return std::nullopt;
  std::string own = name.substr(kPlant.size());
  if (varied_.contains(own) || shared_.contains(own)) return std::nullopt;
  return own;
}

/// Own events first, then those of the method and the plant, then "observer.event".
std::optional<std::string> DynamicsNames::event(const model::Component* component,
                                                const std::string& name) const {
  const auto has = [](const std::vector<model::EventText>& events, const std::string& one) {
    return has_named(events, one);
  };
  if (component != nullptr && has(component->events, name)) return full_name(*component, name);
  if (has(method_->events, name) || has(method_->plant.events, name)) return name;
  if (const auto own = of_part(name); own && has(method_->plant.events, *own)) return own;
  for (const model::Component& observer : method_->observers) {
    const std::string prefix = observer.name + ".";
    if (name.starts_with(prefix) && has(observer.events, name.substr(prefix.size()))) return name;
    const bool only = method_->observers.size() == 1;
    if (component == nullptr && only && has(observer.events, name))
      return full_name(observer, name);
  }
  return std::nullopt;
}

/// Own events without a prefix, those of other observers with theirs.
std::vector<std::string> DynamicsNames::event_names(const model::Component* component) const {
  std::vector<std::string> names;
  const auto add = [&](const std::vector<model::EventText>& events, const std::string& prefix) {
    for (const model::EventText& event : events) names.push_back(prefix + event.name);
  };
  if (component != nullptr) add(component->events, "");
  add(method_->events, "");
  if (component != &method_->plant) add(method_->plant.events, "");
  for (const model::Component& observer : method_->observers)
    if (&observer != component) add(observer.events, observer.name + ".");
  return names;
}

/// Own names get the prefix of the component. Names of events stay where they are names of the
/// plant too.
expr::Expression DynamicsNames::within(const model::Component& component,
                                       const expr::Expression& text,
                                       const std::vector<std::string>& parameters) const {
  const std::set<std::string> own = names_of(component);
  return expr::renamed(text, [&](const std::string& name) -> std::optional<std::string> {
    if (std::find(parameters.begin(), parameters.end(), name) != parameters.end())
      return std::nullopt;
    if (own.contains(name)) return full(component, name);
    if (shared_.contains(name) && is_output_of_plant(name)) return std::string(kPlant) + name;
    if (component.name == kPlantName && varied_.contains(name)) return std::string(kPlant) + name;
    if (name.ends_with(kLeft))
      if (const auto of = event(&component, name.substr(0, name.size() - kLeft.size())))
        return *of + std::string(kLeft);
    if (const auto found = event(&component, name); found && !anywhere_.contains(name))
      return found;
    return of_part(name);
  });
}

expr::Expression DynamicsNames::of_plant(const expr::Expression& text,
                                         const std::vector<std::string>& parameters) const {
  return expr::renamed(text, [&](const std::string& name) -> std::optional<std::string> {
    const bool own = std::find(parameters.begin(), parameters.end(), name) != parameters.end();
    if (own || !varied_.contains(name)) return std::nullopt;
    return std::string(kPlant) + name;
  });
}

/// The names in texts that only observers have.
std::set<std::string> DynamicsNames::bare_names(const std::vector<expr::Expression>& texts) const {
  std::set<std::string> bare;
  for (const expr::Expression& text : texts)
    expr::visit_names(text, [&](const expr::Node& node) {
      for (const model::Component& observer : method_->observers)
        if (!anywhere_.contains(node.text) && has(observer.name, node.text)) bare.insert(node.text);
    });
  return bare;
}

/// Whether it is a name of the observer, or a signal that was read for it.
bool DynamicsNames::has(const std::string& observer, const std::string& name) const {
  const auto signals = readings_.find(observer);
  return own_.at(observer).contains(name) ||
         (signals != readings_.end() && signals->second.contains(name));
}

/// Bare names get the prefix of the observer; "plant." is dropped where the plant's names have
/// none.
Reading DynamicsNames::reading(const std::string& observer, const std::set<std::string>& bare,
                               const std::vector<expr::Expression>& texts) const {
  const auto to = [&](const std::string& name) -> std::optional<std::string> {
    if (bare.contains(name)) return observer + "." + name;
    if (name.ends_with(kLeft))
      if (const auto of = event(nullptr, name.substr(0, name.size() - kLeft.size())))
        return *of + std::string(kLeft);
    if (const auto found = event(nullptr, name); found && !anywhere_.contains(name)) return found;
    return of_part(name);
  };
  Reading result{observer, {}};
  for (const expr::Expression& text : texts) result.texts.push_back(expr::renamed(text, to));
  return result;
}

/// InputError for a name of the method that some of the observers which are meant have too: the
/// text would leave the others out.
void DynamicsNames::refuse_captured(const std::set<std::string>& bare, const Place& place) const {
  std::vector<std::string> meant;
  for (const model::Component& observer : method_->observers)
    if (std::all_of(bare.begin(), bare.end(), [&](const std::string& name) {
          return of_method_.contains(name) || has(observer.name, name);
        }))
      meant.push_back(observer.name);
  for (const std::string& name : bare) {
    if (!of_method_.contains(name)) continue;
    const auto owns = [&](const std::string& observer) { return has(observer, name); };
    const auto owner = std::find_if(meant.begin(), meant.end(), owns);
    const auto other = std::find_if_not(meant.begin(), meant.end(), owns);
    if (owner == meant.end() || other == meant.end()) continue;
    throw InputError(place, "'" + name + "' is a name of the observer '" + *owner +
                                "' and of the method, so the others, such as '" + *other +
                                "', would be left out: give that of '" + *owner +
                                "' another name, or write " + *owner + "." + name);
  }
}

/// An observer is meant where it has all bare names of the texts.
std::vector<Reading> DynamicsNames::outside(const std::vector<expr::Expression>& texts) const {
  const std::set<std::string> bare = bare_names(texts);
  if (bare.empty()) return {reading("", bare, texts)};
  refuse_captured(bare, texts.front().place(*texts.front().root));
  std::vector<Reading> readings;
  for (const model::Component& observer : method_->observers)
    if (std::all_of(bare.begin(), bare.end(),
                    [&](const std::string& name) { return has(observer.name, name); }))
      readings.push_back(reading(observer.name, bare, texts));
  if (!readings.empty()) return readings;
  std::string all;
  for (const std::string& name : bare) all += (all.empty() ? "" : ", ") + name;
  throw InputError(texts.front().place(*texts.front().root),
                   "no observer has all of " + all + "; of a certain one it is written " +
                       method_->observers.front().name + "." + *bare.begin());
}

/// Names that the observer has get its prefix; others stay.
Reading DynamicsNames::of_observer(const std::string& observer,
                                   const std::vector<expr::Expression>& texts,
                                   const Place& place) const {
  const std::vector<std::string> observers = names_of_all(method_->observers);
  if (std::find(observers.begin(), observers.end(), observer) == observers.end())
    throw InputError(place,
                     "there is no observer '" + observer + "'" + suggestion(observer, observers));
  std::set<std::string> bare;
  for (const std::string& name : bare_names(texts))
    if (has(observer, name)) bare.insert(name);
  return reading(observer, bare, texts);
}

expr::Expression DynamicsNames::outside(const expr::Expression& text) const {
  const std::vector<Reading> readings = outside(std::vector{text});
  if (readings.size() == 1) return readings.front().texts.front();
  throw InputError(text.place(*text.root), "this is of one observer; write which, such as " +
                                               readings.front().observer + "." +
                                               *bare_names({text}).begin());
}

/// A signal with bare names of observers is one signal for each of them.
std::vector<Reading> DynamicsNames::add_signal(const model::Named& signal) {
  std::vector<Reading> readings = outside(std::vector{signal.value});
  for (const Reading& reading : readings)
    if (reading.observer.empty())
      anywhere_.insert(signal.name);
    else
      readings_[reading.observer].insert(signal.name);
  return readings;
}

/// That of the plant comes first; "observer.x" is one state, a bare x that of each observer which
/// has it.
std::vector<std::string> DynamicsNames::states(const std::string& name) const {
  const auto has = [](const model::Component& component, const std::string& one) {
    return has_named(component.states, one) || has_named(component.modes, one);
  };
  const std::string own = name.starts_with(kPlant) ? name.substr(kPlant.size()) : name;
  if (has(method_->plant, own)) return {full(method_->plant, own)};
  std::vector<std::string> found;
  for (const model::Component& observer : method_->observers) {
    const std::string prefix = observer.name + ".";
    if (name.starts_with(prefix) && has(observer, name.substr(prefix.size()))) return {name};
    if (has(observer, name)) found.push_back(full_name(observer, name));
  }
  return found;
}

std::string DynamicsNames::title(const std::string& name, const std::string& observer) const {
  if (observer.empty() || method_->observers.size() == 1) return name;
  return observer + "." + name;
}

}  // namespace gainsmith::bind
