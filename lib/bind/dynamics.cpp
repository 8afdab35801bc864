// Components, their states, definitions and flows.
#include <algorithm>
#include <memory>
#include <utility>

#include "base/named.h"
#include "base/nearest.h"
#include "bind/binding.h"
#include "bind/dynamics_binding.h"
#include "bind/formulas.h"
#include "expr/binding/compile.h"
#include "expr/program/rewrite.h"

namespace gainsmith::bind {

namespace {

using Kind = model::Dynamics::VariableKind;

/// States and modes as they are written, for messages.
std::vector<std::string> state_names(const model::Component& component) {
  std::vector<std::string> names;
  for (const auto* list : {&component.states, &component.modes})
    for (const model::Declaration& state : *list) names.push_back(state.name);
  return names;
}

}  // namespace

DynamicsBinding::DynamicsBinding(const model::Method& method, const model::Dimensions& dimensions,
                                 const DynamicsNames& names,
                                 const std::vector<model::UncertainText>& uncertain,
                                 const std::map<std::string, expr::Expression>& data_texts,
                                 expr::Scope& scope)
    : method_(&method),
      dimensions_(&dimensions),
      names_(&names),
      uncertain_(&uncertain),
      data_texts_(&data_texts),
      scope_(&scope) {}

model::Formula DynamicsBinding::formula(const expr::Expression& text, const expr::Scope& scope,
                                        std::optional<expr::Shape> shape) const {
  return {expr::compile(text, scope, shape), text.place(*text.root), text.text->str()};
}

bool DynamicsBinding::is_moving(const std::string& name) const {
  return has_named(result_.variables, name);
}

bool DynamicsBinding::is_free(const std::string& name) const {
  return !scope_->symbols.contains(name) && !scope_->definitions.contains(name) &&
         !scope_->functions.contains(name);
}

expr::Shape DynamicsBinding::shape_of(const model::Declaration& state) const {
  if (const auto shape = resolve(state.shape, *dimensions_)) return *shape;
  throw InputError(state.place, "the size of the state " + state.name + " (" + state.shape.text +
                                    ") does not follow from the data; a shape is n x p, n, scalar, "
                                    "symmetric n or diagonal n, with sizes that the data have");
}

void DynamicsBinding::add_component(const model::Component& component) {
  model::Dynamics::Component bound;
  bound.name = component.name;
  bound.observer = component.name != "plant";
  bound.place = component.place;
  result_.components.push_back(std::move(bound));
}

/// States and modes; modes are whole numbers that jumps alone change.
void DynamicsBinding::add_states(const model::Component& component, std::size_t at) {
  for (const auto* list : {&component.states, &component.modes})
    for (const model::Declaration& state : *list) {
      model::Dynamics::Variable bound;
      bound.kind = list == &component.modes ? Kind::mode : Kind::state;
      bound.name = names_->full(component, state.name);
      bound.component = at;
      bound.shape = shape_of(state);
      bound.structure = state.shape.structure;
      bound.place = state.place;
      scope_->symbols[bound.name] = {bound.shape, false, true, bound.kind == Kind::mode};
      result_.variables.push_back(std::move(bound));
    }
}

/// Outputs are definitions too. One that exists at an event alone is noted with it.
void DynamicsBinding::add_definitions(const model::Component& component) {
  for (const model::Let& let : component.let)
    scope_->definitions[names_->full(component, let.signature.name)] = {
        let.signature.parameters, names_->within(component, let.body, let.signature.parameters)};
  for (const model::Output& output : component.outputs) {
    const std::string name = names_->full(component, output.name);
    scope_->definitions[name] = {{}, names_->within(component, output.value)};
    if (!output.at.empty()) output_events_[name] = output.at;
    if (component.name == "plant") outputs_of_plant_.insert(name);
  }
}

/// The values of a text, or the members of the family that it names as vertices.
std::vector<expr::Expression> DynamicsBinding::values_of(const model::UncertainText& text,
                                                         expr::Shape shape) const {
  std::vector<expr::Expression> vertices;
  if (text.kind == model::Dynamics::NoiseKind::vertices && text.values.size() == 1) {
    const expr::Expression& only = text.values.front().value;
    const auto family = scope_->families.find(only.root->text);
    if (only.root->kind == expr::NodeKind::name && family != scope_->families.end()) {
      if (family->second.size() != 1)
        throw InputError(text.place, "vertices: the family " + family->first +
                                         " has several indices; list its members");
      for (int k = family->second[0].first; k <= family->second[0].second; ++k) {
        auto member = std::make_shared<expr::Node>(*only.root);
        member->text = expr::member_name(family->first, {k});
        vertices.push_back({only.text, member});
      }
      return vertices;
    }
  }
  for (const model::Value& value : text.values)
    vertices.push_back(oriented(value, is_proper_column(shape)));
  return vertices;
}

/// How the plant's value of uncertain data is chosen.
model::Dynamics::Noise DynamicsBinding::varied_noise(const model::UncertainText& text,
                                                     expr::Shape shape) const {
  model::Dynamics::Noise noise;
  noise.name = "plant." + text.name;
  noise.kind = text.kind;
  noise.shape = shape;
  noise.covariance = text.covariance;
  noise.place = text.place;
  const std::optional<expr::Shape> fixed = noise.has_center() ? std::nullopt : std::optional(shape);
  for (const expr::Expression& value : values_of(text, shape))
    noise.values.push_back(constant(value, fixed));
  if (noise.has_center()) check_spread(noise.values, noise.covariance, shape, text.name);
  return noise;
}

/// Why a name is none that may be uncertain.
std::string DynamicsBinding::no_datum(const std::string& name) const {
  if (scope_->definitions.contains(name))
    return "a definition: write it, or what it uses, under 'data'";
  std::vector<std::string> data;
  for (const auto& [symbol, about] : scope_->symbols)
    if (about.known) data.push_back(symbol);
  return "no datum and no parameter" + suggestion(name, data);
}

/// Uncertain data as the plant has them, chosen once a run, and what uses them: definitions, and
/// other data, which are definitions of the plant then.
void DynamicsBinding::add_varied() {
  for (const model::UncertainText& text : *uncertain_) {
    const auto datum = scope_->symbols.find(text.name);
    if (datum == scope_->symbols.end() || !datum->second.known)
      throw InputError(text.place, "uncertain: '" + text.name + "' is " + no_datum(text.name));
    if (!is_free("plant." + text.name))
      throw InputError(text.place, "uncertain: '" + text.name + "' also names a part of the plant");
    add_noise(varied_noise(text, datum->second.shape));
  }
  for (const std::string& name : names_->varied()) {
    if (const auto found = scope_->definitions.find(name); found != scope_->definitions.end())
      scope_->definitions["plant." + name] = {
          found->second.parameters, names_->of_plant(found->second.body, found->second.parameters)};
    else if (const auto text = data_texts_->find(name);
             text != data_texts_->end() && !scope_->symbols.contains("plant." + name))
      scope_->definitions["plant." + name] = {{}, names_->of_plant(text->second, {})};
  }
}

/// An input that reads a state would be part of the plant: it is refused.
void DynamicsBinding::add_inputs() {
  for (const model::Named& input : method_->inputs) {
    expr::visit_names(input.value, [&](const expr::Node& node) {
      if (is_moving(node.text))
        throw InputError(input.value.place(node),
                         "an input is a function of the time t; '" + node.text + "' is a state");
    });
    scope_->definitions[input.name] = {{}, input.value};
  }
  // Before t and j, which may be dropped: flows know variables by their numbers.
  for (const model::MeasuredText& text : method_->measured) add_measured(text);
  for (const char* name : {"t", "j"}) {
    if (!is_free(name)) continue;
    model::Dynamics::Variable number;
    number.kind = name == std::string("t") ? Kind::time : Kind::jumps;
    if (number.kind == Kind::time) scope_->time = name;
    number.name = name;
    scope_->symbols[name] = {{}, false, true};
    result_.variables.push_back(std::move(number));
  }
}

/// The quantity is a variable that rests, or one whose rate is another variable that rests.
void DynamicsBinding::add_measured(const model::MeasuredText& text) {
  if (!is_free(text.name))
    throw InputError(text.place, "'" + text.name + "' already names something else");
  model::Dynamics::Variable variable;
  variable.kind = Kind::measured;
  variable.name = text.name;
  variable.of = result_.measured.size();
  variable.shape = {static_cast<int>(text.series->values.cols()), 1};
  variable.place = text.place;
  const std::size_t at = result_.variables.size();
  scope_->symbols[variable.name] = {variable.shape};
  result_.variables.push_back(variable);
  result_.measured.push_back(
      {text.name, text.between, text.series, text.output, std::nullopt, text.place});
  if (text.between == model::Between::hold) return;
  variable.kind = Kind::measured_rate;
  variable.name = "rate of " + text.name;
  scope_->symbols[variable.name] = {variable.shape};
  result_.variables.push_back(variable);
  expr::Composer rate(text.place);
  const int input = rate.input(variable.name, variable.shape);
  result_.flow.push_back({at, {rate.take(input), text.place, variable.name}, text.place});
}

/// The event of a measured quantity has the rows at which it has a value.
void DynamicsBinding::bind_measured_events() {
  for (std::size_t k = 0; k < method_->measured.size(); ++k) {
    const model::MeasuredText& text = method_->measured[k];
    if (text.at.empty()) continue;
    const std::size_t at = event(&method_->plant, text.at, text.place);
    result_.measured[k].event = at;
    // At a row that has no value of an output of the event there is no event.
    const auto has = [](const std::vector<double>& times, double t) {
      return std::binary_search(times.begin(), times.end(), t);
    };
    std::erase_if(result_.events[at].rows, [&](double t) {
      return has(text.series->silent, t) && !has(text.series->times, t);
    });
  }
}

/// A start may name what has a value before: data, gains, and the states before it.
void DynamicsBinding::bind_starts() {
  std::size_t at = 0;
  const auto bind = [&](const model::Component& component) {
    for (const auto* list : {&component.states, &component.modes})
      for (const model::Declaration& state : *list) {
        model::Dynamics::Variable& bound = result_.variables[at++];
        if (state.fallback)
          bound.start = formula(names_->within(component, *state.fallback), *scope_, bound.shape);
      }
  };
  bind(method_->plant);
  for (const model::Component& observer : method_->observers) bind(observer);
}

std::size_t DynamicsBinding::state(const model::Component& component, std::size_t at,
                                   const model::Named& entry, const char* what) const {
  const std::string name = names_->full(component, entry.name);
  for (std::size_t k = 0; k < result_.variables.size(); ++k) {
    const model::Dynamics::Variable& variable = result_.variables[k];
    const bool own = variable.kind == Kind::state || variable.kind == Kind::mode;
    if (own && variable.component == at && variable.name == name) return k;
  }
  throw InputError(entry.place, std::string(what) + " of '" + entry.name +
                                    "', which is no state of " + component.name +
                                    suggestion(entry.name, state_names(component)));
}

/// x' = formula in the shape of x, over what the component may read.
void DynamicsBinding::bind_flow(const model::Component& component, std::size_t at) {
  for (const model::Named& entry : component.flow) {
    const std::size_t of = state(component, at, entry, "the flow");
    const model::Dynamics::Variable& variable = result_.variables[of];
    if (variable.kind == Kind::mode)
      throw InputError(entry.place, "the mode '" + entry.name +
                                        "' does not flow; what flows is a "
                                        "state");
    const expr::Expression text = names_->within(component, entry.value);
    check_reads({&component, std::nullopt}, text, *scope_);
    result_.flow.push_back({of, formula(text, *scope_, variable.shape), entry.place});
  }
}

/// Components and their names, inputs and events come before any formula, since formulas may name
/// them in any order.
model::Dynamics DynamicsBinding::run() {
  std::vector<const model::Component*> parts = {&method_->plant};
  for (const model::Component& observer : method_->observers) parts.push_back(&observer);
  for (std::size_t at = 0; at < parts.size(); ++at) {
    add_component(*parts[at]);
    add_states(*parts[at], at);
  }
  add_varied();
  for (const model::Component* part : parts) add_definitions(*part);
  add_inputs();
  add_events();
  bind_measured_events();
  for (const model::NoiseText& noise : method_->noise) bind_noise(noise);
  bind_starts();
  for (std::size_t at = 0; at < parts.size(); ++at) {
    set_reader(parts[at]);
    bind_flow(*parts[at], at);
    bind_flow_sets(*parts[at], at);
  }
  for (std::size_t at = 0; at < result_.events.size(); ++at) {
    const auto of = result_.events[at].component;
    set_reader(of ? parts[*of] : nullptr);
    bind_event(*event_texts_[at], of ? parts[*of] : nullptr, at);
  }
  for (std::size_t at = 0; at < parts.size(); ++at) {
    set_reader(parts[at]);
    for (const model::ReactionText& reaction : parts[at]->at)
      bind_reaction(reaction, *parts[at], at);
  }
  set_reader(nullptr);
  return result_;
}

/// None for an output that exists at all times.
std::optional<std::size_t> DynamicsBinding::event_of_output(const std::string& output) const {
  const auto found = output_events_.find(output);
  if (found == output_events_.end()) return std::nullopt;
  return events_.at(*names_->event(nullptr, found->second));
}

/// States, modes, noise and measured quantities stay in any case.
void drop_unread(model::Dynamics& dynamics, const std::set<std::string>& read) {
  std::erase_if(dynamics.variables, [&](const model::Dynamics::Variable& variable) {
    const bool asked = variable.kind != Kind::state && variable.kind != Kind::mode &&
                       variable.kind != Kind::noise && variable.kind != Kind::measured &&
                       variable.kind != Kind::measured_rate;
    return asked && !read.contains(variable.name);
  });
}

}  // namespace gainsmith::bind
