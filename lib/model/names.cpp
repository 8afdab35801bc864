#include "model/names.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/nearest.h"
#include "expr/binding/functions.h"

namespace gainsmith::model {

namespace {

bool is_name(const std::string& text) {
  const auto is_letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; };
  const auto is_part = [&](char c) { return is_letter(c) || c == '_' || (c >= '0' && c <= '9'); };
  return !text.empty() && (is_letter(text[0]) || text[0] == '_') &&
         std::all_of(text.begin(), text.end(), is_part);
}

std::string with_article(const std::string& noun) {
  const bool vowel = std::string_view("aeiou").find(noun.front()) != std::string_view::npos;
  return (vowel ? "an " : "a ") + noun;
}

/// Names with what they are. InputError at the second place of a name that is taken or reserved.
class NameCheck {
 public:
  /// A dimension may occur in several shapes.
  void add_dimensions(const ShapeText& shape) {
    for (const auto& size : {shape.rows, shape.cols})
      if (size)
        for (const std::string& name : names_in(*size)) {
          if (expr::is_reserved(name))
            throw InputError(
                shape.place,
                "'" + name + "' is a word of the language and cannot name a " + "dimension");
          known_.emplace(name, "dimension");
        }
  }

  /// The variable of a `forall` may be the name of the timer, of a state, which no inequality has,
  /// or of another `forall`, nothing else.
  void check_variable(const Forall& forall) const {
    const auto found = known_.find(forall.variable);
    if (expr::is_reserved(forall.variable))
      throw InputError(forall.place, "'" + forall.variable + "' is a word of the language");
    if (found != known_.end() && found->second != "timer" && !found->second.starts_with("state "))
      throw InputError(forall.place,
                       "'" + forall.variable + "' is a variable here, but it already names " +
                           with_article(found->second) + place_of(forall.variable, forall.place));
  }

  /// An index may be that of another family, nothing else.
  void check_indices(const std::vector<expr::Index>& indices) const {
    std::map<std::string, int> counts;
    for (const expr::Index& index : indices) {
      if (++counts[index.name] > 1)
        throw InputError(index.place, "the index '" + index.name + "' is given twice");
      if (expr::is_reserved(index.name) || index.name == "in")
        throw InputError(index.place, "'" + index.name + "' is a word of the language");
      if (const auto found = known_.find(index.name); found != known_.end())
        throw InputError(index.place,
                         "'" + index.name + "' is an index here, but it already names " +
                             with_article(found->second) + place_of(index.name, index.place));
    }
  }

  void add(const std::string& name, const std::string& what, const Place& place) {
    if (!is_name(name))
      throw InputError(place, "'" + name + "' is no name: expected letters, digits and _");
    if (expr::is_reserved(name))
      throw InputError(
          place, "'" + name + "' is a word of the language and cannot name " + with_article(what));
    const auto [found, fresh] = known_.emplace(name, what);
    if (!fresh)
      throw InputError(place, "'" + name + "' names " + with_article(what) +
                                  " here, but it already names " + with_article(found->second) +
                                  place_of(name, place));
    places_.emplace(name, place);
  }

  /// The coefficients of a function YL are YL_0, YL_1, ..., the members of a family P are P_1, P_2,
  /// ...: none of them may name anything else.
  void reserve_numbered(const std::string& owner, const std::string& what,
                        const std::string& kind) const {
    const auto clash = std::find_if(places_.begin(), places_.end(), [&](const auto& entry) {
      return is_numbered(entry.first, owner);
    });
    if (clash == places_.end()) return;
    throw InputError(clash->second, "'" + clash->first + "' is the name of a " + what + " of " +
                                        owner + ", which is a " + kind);
  }

  /// Adds a name of the plant of a method with events: what the method has under it is hidden in
  /// the plant.
  void add_hiding(const std::string& name, const std::string& what, const Place& place) {
    static const std::set<std::string> kHidden = {"datum", "parameter", "unknown", "definition",
                                                  "gain"};
    const auto found = known_.find(name);
    if (found == known_.end() || !kHidden.contains(found->second)) add(name, what, place);
  }

  void check_parameter(const std::string& name, const Place& place) const {
    if (!is_name(name))
      throw InputError(place,
                       "the variable '" + name + "' is no name: expected letters, digits and _");
    if (expr::is_reserved(name))
      throw InputError(place, "the variable '" + name + "' is a word of the language");
  }

 private:
  /// ", in line 7", or ", at p.yaml:7:3" of another file: where it got its name.
  std::string place_of(const std::string& name, const Place& seen_from) const {
    const auto found = places_.find(name);
    if (found == places_.end() || found->second.line == 0) return "";
    if (found->second.file != seen_from.file) return ", at " + to_string(found->second);
    return ", in line " + std::to_string(found->second.line);
  }

  std::map<std::string, std::string> known_;
  std::map<std::string, Place> places_;
};

void check_families(const Method& method, const NameCheck& names) {
  const auto check = [&](const std::string& name, const std::vector<expr::Index>& indices) {
    names.check_indices(indices);
    if (!indices.empty()) names.reserve_numbered(name, "member", "family");
  };
  for (const Declaration& datum : method.data) check(datum.name, datum.indices);
  for (const UnknownDeclaration& unknown : method.unknowns) check(unknown.name, unknown.indices);
  for (const Gain& gain : method.gains) check(gain.name, gain.indices);
  for (const Claim& claim : method.claims) names.check_indices(claim.indices);
  for (const auto* list : {&method.require, &method.necessary})
    for (const Requirement& requirement : *list) names.check_indices(requirement.indices);
}

/// Each entry names a state of the component.
void check_maps(const Component& component, const std::vector<Named>& map,
                const std::string& what) {
  std::vector<std::string> states;
  for (const Declaration& state : component.states) states.push_back(state.name);
  for (const Named& entry : map) {
    bool known = false;
    for (const std::string& state : states) known |= state == entry.name;
    if (!known)
      throw InputError(entry.place, what + " of '" + entry.name + "', which is no state" +
                                        suggestion(entry.name, states));
  }
}

using Add = void (NameCheck::*)(const std::string&, const std::string&, const Place&);

void add_component(const Component& component, NameCheck& names, Add add = &NameCheck::add) {
  const std::string whose =
      component.name == "plant" || component.name == "observer" ? " of the " : " of the observer ";
  const auto add_one = [&](const std::string& name, const char* what, const Place& place) {
    (names.*add)(name, what + whose + component.name, place);
  };
  for (const Declaration& state : component.states) add_one(state.name, "state", state.place);
  for (const Declaration& mode : component.modes) add_one(mode.name, "mode", mode.place);
  for (const Output& output : component.outputs) add_one(output.name, "output", output.place);
  for (const Let& let : component.let) add_one(let.signature.name, "definition", let.place);
}

void add_gains(const Method& method, NameCheck& names) {
  for (const Gain& gain : method.gains) {
    // "L: L": the gain is the datum (an analysis of given gains) or the unknown itself.
    const expr::Node& root = *gain.value.root;
    const bool is_itself =
        gain.variable.empty() && root.kind == expr::NodeKind::name && root.text == gain.name;
    if (!is_itself) names.add(gain.name, "gain", gain.place);
  }
}

/// Outputs of a plant that is a log have names already.
void add_inputs(const Method& method, NameCheck& names) {
  for (const Named& input : method.inputs) names.add(input.name, "input", input.place);
  for (const MeasuredText& input : method.measured)
    if (!input.output) names.add(input.name, "input", input.place);
}

/// Plant and observers have names of their own, which hide those of data, gains and definitions;
/// an observer reads names of the plant.
void check_observers(const Method& method) {
  NameCheck plant;
  add_component(method.plant, plant);
  NameCheck all;
  all.add("plant", "component", method.plant.place);
  for (const Component& observer : method.observers) {
    all.add(observer.name, "observer", observer.place);
    NameCheck names;
    add_component(method.plant, names);
    add_inputs(method, names);
    for (const NoiseText& noise : method.noise) names.add(noise.name, "noise", noise.place);
    add_component(observer, names);
    names.check_indices(observer.indices);
  }
  for (const Component& observer : method.observers)
    if (!observer.indices.empty()) all.reserve_numbered(observer.name, "member", "family");
}

}  // namespace

bool is_numbered(const std::string& name, const std::string& owner) {
  if (!name.starts_with(owner) || name.size() == owner.size()) return false;
  char before = '0';
  for (const char c : name.substr(owner.size())) {
    const bool digit = c >= '0' && c <= '9';
    if (!digit && (c != '_' || before == '_')) return false;
    before = c;
  }
  return name[owner.size()] == '_' && before != '_';
}

void check_scalar_name(const std::string& method, const std::vector<std::string>& scalars,
                       const std::map<std::string, std::string>& shapes, const std::string& name,
                       const Place& place) {
  if (std::find(scalars.begin(), scalars.end(), name) != scalars.end()) return;
  if (const auto matrix = shapes.find(name); matrix != shapes.end())
    throw InputError(place, "'" + name + "' is a matrix (" + matrix->second +
                                "); expected a scalar datum or parameter");
  if (name == kGainBound) return;
  if (const std::size_t bracket = name.find_first_of("(["); bracket != std::string::npos)
    throw InputError(place, "'" + name + "' is an element of '" + name.substr(0, bracket) +
                                "'; expected the name of a scalar datum or parameter");
  std::vector<std::string> known = scalars;
  known.emplace_back(kGainBound);
  throw InputError(place, "the method " + method + " has no scalar datum or parameter '" + name +
                              "'" + suggestion(name, known));
}

void check_names(const Method& method) {
  NameCheck names;
  std::vector<const std::vector<Declaration>*> declared = {&method.data, &method.plant.states};
  for (const Component& observer : method.observers) declared.push_back(&observer.states);
  for (const auto* list : declared)
    for (const Declaration& declaration : *list) names.add_dimensions(declaration.shape);
  for (const UnknownDeclaration& unknown : method.unknowns) names.add_dimensions(unknown.shape);
  for (const Declaration& datum : method.data) {
    names.add(datum.name, "datum", datum.place);
    for (const Argument& argument : datum.arguments) {
      names.add_dimensions(argument.shape);
      names.check_parameter(argument.name, argument.place);
    }
  }
  for (const Parameter& parameter : method.parameters)
    names.add(parameter.name, "parameter", parameter.place);
  for (const UnknownDeclaration& unknown : method.unknowns)
    names.add(unknown.name, "unknown", unknown.place);
  for (const Let& let : method.let) names.add(let.signature.name, "definition", let.place);
  add_gains(method, names);
  add_component(method.plant, names, &NameCheck::add_hiding);
  check_maps(method.plant, method.plant.flow, "the flow");
  add_inputs(method, names);
  for (const NoiseText& noise : method.noise) names.add(noise.name, "noise", noise.place);
  check_observers(method);
  for (const EventText& event : method.events)
    if (!event.left.empty()) names.add(event.left, "timer", event.place);
  for (const Named& signal : method.signals) names.add(signal.name, "signal", signal.place);
  for (const UnknownDeclaration& unknown : method.unknowns) {
    if (unknown.variable.empty()) continue;
    names.check_parameter(unknown.variable, unknown.place);
    names.reserve_numbered(unknown.name, "coefficient", "function");
  }
  for (const Gain& gain : method.gains) {
    if (gain.variable.empty()) continue;
    names.check_parameter(gain.variable, gain.place);
    names.reserve_numbered(gain.name, "coefficient", "function");
  }
  std::vector<Requirement> requirements = method.require;
  requirements.insert(requirements.end(), method.necessary.begin(), method.necessary.end());
  for (const Requirement& requirement : requirements) {
    std::map<std::string, Place> variables;
    const auto add = [&](const std::string& name, const Place& place) {
      if (!variables.emplace(name, place).second)
        throw InputError(place, "'" + name + "' is given twice in 'forall'");
    };
    for (const expr::Index& index : requirement.indices) add(index.name, index.place);
    for (const Forall& forall : requirement.forall) {
      names.check_variable(forall);
      add(forall.variable, forall.place);
    }
  }
  check_families(method, names);
}

}  // namespace gainsmith::model
