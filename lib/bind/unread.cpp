// Names that a person declares and no text reads are likely to be mistakes. They are told, not
// refused.
#include <algorithm>

#include "bind/binding.h"

namespace gainsmith::bind {

/// A member P_2 counts as a read of P, and "observer.x" as one of x.
std::vector<std::string> unread_names(const Binding& binding, const std::set<std::string>& read) {
  const model::Method& method = binding.method();
  std::vector<std::string> sentences;
  // What is declared elsewhere may be meant for other problems.
  const auto is_own = [&](const auto& one) { return one.place.file == binding.problem().file; };
  std::set<std::string> defaults;
  for (const model::Declaration& declaration : method.data)
    if (declaration.fallback) defaults.merge(expr::names_in(*declaration.fallback));
  // Also by a member of its family or by a part of a component.
  const auto is_read = [&](const std::string& name) {
    const auto member = read.lower_bound(name + "_");
    const auto is_of_part = [&](const auto& one) { return one.ends_with("." + name); };
    return read.contains(name) || std::ranges::any_of(read, is_of_part) ||
           defaults.contains(name) || (member != read.end() && member->starts_with(name + "_"));
  };
  const auto say = [&](const std::string& what, const std::string& name, const auto& of) {
    if (is_own(of) && !is_read(name))
      sentences.push_back("nothing reads the " + what + " '" + name + "'");
  };
  const auto add = [&](const std::string& what, const auto& list) {
    for (const auto& one : list) say(what, one.name, one);
  };
  add("datum", method.data);
  add("parameter", method.parameters);
  add("input", method.inputs);
  add("noise", method.noise);
  for (const model::Let& let : method.let) say("definition", let.signature.name, let);
  if (!method.observers.empty()) add("output", method.plant.outputs);
  for (const model::Component& observer : method.observers) add("state", observer.states);
  // A formula of other gains tells of these, as a covariance does.
  const auto is_alone = [&](const model::Gain& gain) {
    const std::set<std::string> names = expr::names_in(gain.value);
    return std::ranges::none_of(method.gains,
                                [&](const auto& one) { return names.contains(one.name); });
  };
  for (const model::Gain& gain : method.gains)
    if (method.has_dynamics && is_own(gain) && !is_read(gain.name) && is_alone(gain))
      sentences.push_back("neither the plant nor an observer reads the gain '" + gain.name +
                          "': the runs say nothing of it");
  return sentences;
}

}  // namespace gainsmith::bind
