#include "support/dynamics_text.h"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <utility>

#include "expr/binding/compile.h"
#include "expr/text/parser.h"

namespace gainsmith::tests {

namespace {

using model::Dynamics;
using Kind = Dynamics::VariableKind;

constexpr const char* kFile = "test.yaml";
const Place kPlace{kFile, 1, 1};

model::Formula unbound(const std::string& text) { return {{}, kPlace, text}; }

std::optional<model::Formula> maybe(const std::string& text) {
  if (text.empty()) return std::nullopt;
  return unbound(text);
}

expr::Condition unbound_condition(const std::string& text) {
  expr::Condition condition;
  condition.text = text;
  condition.place = kPlace;
  return condition;
}

/// What the run itself has a value of, under its name.
std::vector<Dynamics::Variable> of_the_run(const Dynamics& dynamics) {
  std::vector<Dynamics::Variable> result;
  const auto add = [&](Kind kind, const std::string& name, std::size_t of) {
    Dynamics::Variable variable;
    variable.kind = kind;
    variable.name = name;
    variable.of = of;
    result.push_back(std::move(variable));
  };
  add(Kind::time, "t", 0);
  add(Kind::jumps, "j", 0);
  for (std::size_t i = 0; i < dynamics.events.size(); ++i) {
    const std::string& name = dynamics.events[i].name;
    add(Kind::count, expr::event_number("count", name), i);
    add(Kind::since, expr::event_number("since", name), i);
    add(Kind::passes, expr::event_number("passes", name), i);
    if (dynamics.events[i].kind == Dynamics::EventKind::every) add(Kind::left, name + ".left", i);
  }
  return result;
}

/// Gives the formulas of a Dynamics their programs.
class TextBinder {
 public:
  explicit TextBinder(expr::Scope scope) : scope_(std::move(scope)) {}

  void bind(model::Formula& formula, std::optional<expr::Shape> shape = std::nullopt) {
    formula.program = expr::compile(parse(formula.text), scope_, shape);
    note(formula.program);
  }
  void bind(std::optional<model::Formula>& formula,
            std::optional<expr::Shape> shape = std::nullopt) {
    if (formula) bind(*formula, shape);
  }
  void bind(expr::Condition& condition) {
    condition = expr::compile_condition(parse(condition.text), scope_);
    note(condition);
  }
  void bind(std::optional<expr::Condition>& condition) {
    if (condition) bind(*condition);
  }
  void bind(std::vector<Dynamics::Assignment>& map,
            const std::vector<Dynamics::Variable>& variables) {
    for (Dynamics::Assignment& entry : map) bind(entry.value, variables[entry.variable].shape);
  }

  bool used(const std::string& name) const { return used_.contains(name); }

 private:
  static expr::Expression parse(const std::string& text) {
    return expr::parse(expr::Text(text, kFile));
  }
  void note(const expr::Program& program) {
    for (const expr::Input& input : program.inputs) used_.insert(input.name);
  }
  void note(const expr::Condition& condition) {
    if (condition.is_comparison()) note(condition.difference);
    for (const expr::Condition& part : condition.parts) note(part);
  }

  expr::Scope scope_;
  std::set<std::string> used_;
};

void bind_event(Dynamics::Event& event, TextBinder& binder) {
  const expr::Shape number{1, 1};
  binder.bind(event.condition);
  binder.bind(event.crossing, number);
  for (std::optional<model::Formula>* formula :
       {&event.low, &event.high, &event.first_low, &event.first_high})
    binder.bind(*formula, number);
  for (model::Formula& times : event.times) binder.bind(times);
  binder.bind(event.only_if);
}

void bind_all(Dynamics& dynamics, TextBinder& binder) {
  const expr::Shape number{1, 1};
  for (Dynamics::Component& component : dynamics.components) {
    binder.bind(component.frozen);
    for (Dynamics::Component::FlowSet& flow_set : component.flow_sets) binder.bind(flow_set.where);
  }
  for (Dynamics::Variable& variable : dynamics.variables)
    binder.bind(variable.start, variable.shape);
  binder.bind(dynamics.flow, dynamics.variables);
  for (Dynamics::Event& event : dynamics.events) bind_event(event, binder);
  for (Dynamics::Reaction& reaction : dynamics.reactions)
    for (Dynamics::Pass& pass : reaction.passes) {
      binder.bind(pass.map, dynamics.variables);
      binder.bind(pass.until);
      binder.bind(pass.at_most, number);
    }
  for (Dynamics::Noise& noise : dynamics.noise) {
    for (model::Formula& value : noise.values) binder.bind(value);
    binder.bind(noise.every, number);
  }
  for (Dynamics::Signal& signal : dynamics.signals) binder.bind(signal.value);
}

}  // namespace

DynamicsText::DynamicsText() {
  Dynamics::Component plant;
  plant.name = "plant";
  unbound_.components.push_back(std::move(plant));
}

DynamicsText& DynamicsText::datum(const std::string& name, const numbers::Matrix& value) {
  data_[name] = value;
  return *this;
}

DynamicsText& DynamicsText::observer(const std::string& name) {
  Dynamics::Component component;
  component.name = name;
  component.observer = true;
  unbound_.components.push_back(std::move(component));
  return *this;
}

DynamicsText& DynamicsText::add(Dynamics::Variable variable, const std::string& flow,
                                const std::string& start) {
  variable.component = unbound_.components.size() - 1;
  variable.start = maybe(start);
  variable.place = kPlace;
  unbound_.variables.push_back(std::move(variable));
  if (!flow.empty())
    unbound_.flow.push_back({unbound_.variables.size() - 1, unbound(flow), kPlace});
  return *this;
}

DynamicsText& DynamicsText::state(const std::string& name, expr::Shape shape,
                                  const std::string& flow, const std::string& start) {
  Dynamics::Variable variable;
  variable.name = name;
  variable.shape = shape;
  return add(std::move(variable), flow, start);
}

DynamicsText& DynamicsText::state(const std::string& name, int rows, const std::string& flow,
                                  const std::string& start) {
  return state(name, expr::Shape{rows, 1}, flow, start);
}

DynamicsText& DynamicsText::symmetric(const std::string& name, int rows, const std::string& flow,
                                      const std::string& start) {
  Dynamics::Variable variable;
  variable.name = name;
  variable.shape = {rows, rows};
  variable.structure = model::Structure::symmetric;
  return add(std::move(variable), flow, start);
}

DynamicsText& DynamicsText::mode(const std::string& name, const std::string& start) {
  Dynamics::Variable variable;
  variable.kind = Kind::mode;
  variable.name = name;
  return add(std::move(variable), "", start);
}

DynamicsText& DynamicsText::frozen(const std::string& condition) {
  unbound_.components.back().frozen = unbound_condition(condition);
  return *this;
}

DynamicsText& DynamicsText::flow_set(const std::string& condition, const std::string& say) {
  unbound_.components.back().flow_sets.push_back({unbound_condition(condition), say, kPlace});
  return *this;
}

DynamicsText& DynamicsText::event(const std::string& name, Dynamics::EventKind kind) {
  Dynamics::Event event;
  event.name = name;
  event.own = name;
  event.kind = kind;
  event.place = kPlace;
  unbound_.events.push_back(std::move(event));
  return *this;
}

DynamicsText& DynamicsText::when(const std::string& name, const std::string& condition) {
  event(name, Dynamics::EventKind::when);
  unbound_.events.back().condition = unbound_condition(condition);
  return *this;
}

DynamicsText& DynamicsText::border(const std::string& name, Dynamics::EventKind kind,
                                   const std::string& value) {
  event(name, kind);
  unbound_.events.back().crossing = unbound(value);
  return *this;
}

DynamicsText& DynamicsText::rises(const std::string& name, const std::string& value) {
  return border(name, Dynamics::EventKind::rises, value);
}

DynamicsText& DynamicsText::falls(const std::string& name, const std::string& value) {
  return border(name, Dynamics::EventKind::falls, value);
}

DynamicsText& DynamicsText::crosses(const std::string& name, const std::string& value) {
  return border(name, Dynamics::EventKind::crosses, value);
}

DynamicsText& DynamicsText::every(const std::string& name, const std::string& length) {
  return every(name, length, length);
}

DynamicsText& DynamicsText::every(const std::string& name, const std::string& low,
                                  const std::string& high) {
  event(name, Dynamics::EventKind::every);
  unbound_.events.back().low = unbound(low);
  unbound_.events.back().high = unbound(high);
  return *this;
}

DynamicsText& DynamicsText::at(const std::string& name, const std::vector<std::string>& times) {
  event(name, Dynamics::EventKind::at);
  for (const std::string& text : times) unbound_.events.back().times.push_back(unbound(text));
  return *this;
}

DynamicsText& DynamicsText::first(const std::string& low, const std::string& high) {
  unbound_.events.back().first_low = unbound(low);
  unbound_.events.back().first_high = unbound(high);
  return *this;
}

DynamicsText& DynamicsText::only_if(const std::string& condition) {
  unbound_.events.back().only_if = unbound_condition(condition);
  return *this;
}

DynamicsText& DynamicsText::lost(double probability, std::optional<int> in_a_row) {
  unbound_.events.back().lost = probability;
  unbound_.events.back().lost_in_a_row = in_a_row;
  return *this;
}

Dynamics::Reaction& DynamicsText::reaction(const std::string& event) {
  const std::size_t at = event_of(event);
  const std::size_t component = unbound_.components.size() - 1;
  for (Dynamics::Reaction& known : unbound_.reactions)
    if (known.event == at && known.component == component) return known;
  unbound_.reactions.push_back({at, component, {}, kPlace});
  return unbound_.reactions.back();
}

std::vector<Dynamics::Assignment> DynamicsText::map(const Pairs& entries) const {
  std::vector<Dynamics::Assignment> result;
  for (const auto& [name, text] : entries)
    result.push_back({variable(name), unbound(text), kPlace});
  return result;
}

DynamicsText& DynamicsText::reacts(const std::string& event, const Pairs& entries) {
  Dynamics::Pass pass;
  pass.map = map(entries);
  pass.place = kPlace;
  reaction(event).passes.push_back(std::move(pass));
  return *this;
}

DynamicsText& DynamicsText::repeats(const std::string& event, const Pairs& entries,
                                    const std::string& until, const std::string& at_most,
                                    bool go_on) {
  reacts(event, entries);
  Dynamics::Pass& pass = reaction(event).passes.back();
  pass.repeats = true;
  if (!until.empty()) pass.until = unbound_condition(until);
  pass.at_most = unbound(at_most);
  pass.go_on = go_on;
  return *this;
}

DynamicsText& DynamicsText::measured(const std::string& name, model::Between between,
                                     const std::vector<std::pair<double, double>>& rows) {
  auto series = std::make_shared<model::Series>();
  series->file = "log.csv";
  series->values.resize(static_cast<Eigen::Index>(rows.size()), 1);
  for (const auto& [time, value] : rows) {
    series->values(static_cast<Eigen::Index>(series->times.size()), 0) = value;
    series->times.push_back(time);
  }
  Dynamics::Variable variable;
  variable.name = name;
  variable.of = unbound_.measured.size();
  unbound_.measured.push_back({name, between, std::move(series), false, std::nullopt, kPlace});
  const bool line = between == model::Between::line;
  if (line) {
    variable.kind = Kind::measured_rate;
    variable.name = name + "_rate";
    add(variable, "", "");
  }
  variable.kind = Kind::measured;
  variable.name = name;
  return add(variable, line ? name + "_rate" : "", "");
}

DynamicsText& DynamicsText::noise(const std::string& name, Dynamics::NoiseKind kind,
                                  const std::vector<std::string>& values, int size) {
  Dynamics::Noise noise;
  noise.name = name;
  noise.kind = kind;
  noise.shape = {size, 1};
  for (const std::string& text : values) noise.values.push_back(unbound(text));
  noise.place = kPlace;
  Dynamics::Variable variable;
  variable.kind = Kind::noise;
  variable.name = name;
  variable.shape = noise.shape;
  variable.of = unbound_.noise.size();
  unbound_.noise.push_back(std::move(noise));
  return add(std::move(variable), "", "");
}

DynamicsText& DynamicsText::covariance() {
  unbound_.noise.back().covariance = true;
  return *this;
}

DynamicsText& DynamicsText::drawn_at(const std::string& event) {
  unbound_.noise.back().event = event_of(event);
  return *this;
}

DynamicsText& DynamicsText::drawn_every(const std::string& length) {
  unbound_.noise.back().every = unbound(length);
  return *this;
}

DynamicsText& DynamicsText::signal(const std::string& name, const std::string& value,
                                   const std::string& at) {
  std::optional<std::size_t> event;
  if (!at.empty()) event = event_of(at);
  unbound_.signals.push_back({name, unbound(value), event});
  return *this;
}

std::size_t DynamicsText::variable(const std::string& name) const {
  const auto& all = unbound_.variables;
  const auto found = std::find_if(all.begin(), all.end(), [&](const Dynamics::Variable& variable) {
    return variable.name == name;
  });
  if (found == all.end()) throw std::logic_error("no variable " + name);
  return static_cast<std::size_t>(found - all.begin());
}

std::size_t DynamicsText::event_of(const std::string& name) const {
  const auto& all = unbound_.events;
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const Dynamics::Event& event) { return event.name == name; });
  if (found == all.end()) throw std::logic_error("no event " + name);
  return static_cast<std::size_t>(found - all.begin());
}

Dynamics DynamicsText::dynamics() const {
  Dynamics dynamics = unbound_;
  const std::vector<Dynamics::Variable> run = of_the_run(dynamics);
  expr::Scope scope;
  for (const auto& [name, value] : data_) scope.symbols[name] = {numbers::shape_of(value)};
  for (const Dynamics::Variable& variable : dynamics.variables)
    scope.symbols[variable.name] = {variable.shape};
  for (const Dynamics::Variable& variable : run) scope.symbols[variable.name] = {};
  TextBinder binder(std::move(scope));
  bind_all(dynamics, binder);
  for (const Dynamics::Variable& variable : run)
    if (binder.used(variable.name)) dynamics.variables.push_back(variable);
  return dynamics;
}

model::Stated DynamicsText::stated() const {
  model::Stated stated;
  stated.values = data_;
  return stated;
}

}  // namespace gainsmith::tests
