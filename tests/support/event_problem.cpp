#include "support/event_problem.h"

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "expr/binding/compile.h"
#include "expr/text/parser.h"

namespace gainsmith::tests {

using model::Dynamics;

/// From the texts of a problem to bound ones.
class EventCompiler {
 public:
  explicit EventCompiler(const EventProblem& problem) : problem_(problem) {
    for (const auto& [name, value] : problem.values_)
      scope_.symbols[name] = {numbers::shape_of(value), true};
    scope_.known = std::make_shared<numbers::KnownDoubles>(problem.values_);
    for (const auto& [signature, text] : problem.definitions_) {
      const expr::Signature left = expr::parse_signature({signature, "let"});
      scope_.definitions[left.name] = {left.parameters, expr::parse({text, "let"})};
    }
  }

  Dynamics compile() {
    add_variables();
    for (std::size_t i = 0; i < starts_.size(); ++i)
      if (!starts_[i].empty())
        made_.variables[i].start = formula(starts_[i], made_.variables[i].shape);
    for (const auto& part : problem_.components_) add_component(part);
    for (const auto& [name, text] : problem_.flows_) made_.flow.push_back(assignment(name, text));
    for (const auto& event : problem_.events_) add_event(event);
    for (const auto& jump : problem_.jumps_) add_jump(jump);
    for (const auto& noise : problem_.noise_) add_noise(noise);
    return made_;
  }

 private:
  void add_variable(Dynamics::Variable variable, const std::string& start) {
    scope_.symbols[variable.name] = {variable.shape};
    starts_.push_back(start);
    made_.variables.push_back(std::move(variable));
  }

  void add_variables() {
    Dynamics::Variable run;
    run.kind = Dynamics::VariableKind::time;
    run.name = "t";
    add_variable(run, "");
    run.kind = Dynamics::VariableKind::jumps;
    run.name = "j";
    add_variable(run, "");
    for (const auto& state : problem_.states_) {
      Dynamics::Variable variable = state.variable;
      if (!state.of.empty()) variable.of = event_number(state.of);
      add_variable(variable, state.start);
    }
    for (std::size_t k = 0; k < problem_.noise_.size(); ++k) {
      Dynamics::Variable variable;
      variable.kind = Dynamics::VariableKind::noise;
      variable.name = problem_.noise_[k].name;
      variable.of = k;
      add_variable(variable, "");
    }
  }

  void add_component(const EventProblem::Part& part) {
    Dynamics::Component component;
    component.name = part.name;
    component.observer = part.name != "plant";
    if (!part.frozen.empty()) component.frozen = condition(part.frozen);
    for (const auto& flow_set : part.flow_sets)
      component.flow_sets.push_back({condition(flow_set.condition), flow_set.say, {}});
    made_.components.push_back(std::move(component));
  }

  void add_event(const EventProblem::Happening& text) {
    Dynamics::Event event;
    event.name = event.own = text.name;
    event.kind = text.kind;
    event.lost = text.lost;
    event.lost_in_a_row = text.in_a_row;
    if (!text.only_if.empty()) event.only_if = condition(text.only_if);
    switch (text.kind) {
      case Dynamics::EventKind::when:
        event.condition = condition(text.texts[0]);
        break;
      case Dynamics::EventKind::every:
        event.low = formula(text.texts[0], expr::Shape{});
        event.high = formula(text.texts[1], expr::Shape{});
        if (!text.first.empty())
          event.first_low = event.first_high = formula(text.first, expr::Shape{});
        break;
      case Dynamics::EventKind::at:
        for (const std::string& time : text.texts) event.times.push_back(formula(time));
        break;
      default:
        event.crossing = formula(text.texts[0], expr::Shape{});
    }
    made_.events.push_back(std::move(event));
  }

  void add_jump(const EventProblem::Jump& jump) {
    const std::size_t event = event_number(jump.event);
    auto found = std::find_if(made_.reactions.begin(), made_.reactions.end(), [&](const auto& one) {
      return one.event == event && one.component == jump.component;
    });
    if (found == made_.reactions.end()) {
      made_.reactions.push_back({event, jump.component, {}, {}});
      found = made_.reactions.end() - 1;
    }
    Dynamics::Pass pass;
    for (const auto& [name, text] : jump.map) pass.map.push_back(assignment(name, text));
    pass.repeats = jump.repeats;
    pass.go_on = jump.go_on;
    if (!jump.until.empty()) pass.until = condition(jump.until);
    if (!jump.at_most.empty()) pass.at_most = formula(jump.at_most, expr::Shape{});
    found->passes.push_back(std::move(pass));
  }

  void add_noise(const EventProblem::NoiseText& text) {
    Dynamics::Noise noise;
    noise.name = text.name;
    noise.kind = text.kind;
    for (const std::string& value : text.values) noise.values.push_back(formula(value));
    if (!text.event.empty()) noise.event = event_number(text.event);
    if (!text.every.empty()) noise.every = formula(text.every, expr::Shape{});
    made_.noise.push_back(std::move(noise));
  }

  std::size_t event_number(const std::string& name) const {
    for (std::size_t e = 0; e < problem_.events_.size(); ++e)
      if (problem_.events_[e].name == name) return e;
    throw std::logic_error("no event " + name);
  }

  Dynamics::Assignment assignment(const std::string& name, const std::string& text) const {
    for (std::size_t i = 0; i < made_.variables.size(); ++i)
      if (made_.variables[i].name == name)
        return {i, formula(text, made_.variables[i].shape), {"test", 1, 1}};
    throw std::logic_error("no variable " + name);
  }

  model::Formula formula(const std::string& text,
                         std::optional<expr::Shape> shape = std::nullopt) const {
    return {expr::compile(expr::parse({text, "test"}), scope_, shape), {"test", 1, 1}, text};
  }

  expr::Condition condition(const std::string& text) const {
    return expr::compile_condition(expr::parse({text, "test"}), scope_);
  }

  const EventProblem& problem_;
  expr::Scope scope_;
  std::vector<std::string> starts_;  ///< by variable
  Dynamics made_;
};

EventProblem& EventProblem::data(const std::string& name, const numbers::Matrix& value) {
  values_[name] = value;
  return *this;
}

EventProblem& EventProblem::data(const std::string& name, double value) {
  return data(name, numbers::Matrix::Constant(1, 1, value));
}

EventProblem& EventProblem::let(const std::string& signature, const std::string& text) {
  definitions_[signature] = text;
  return *this;
}

EventProblem& EventProblem::observer(const std::string& name) {
  components_.push_back({name, "", {}});
  return *this;
}

EventProblem& EventProblem::frozen(const std::string& condition) {
  components_.back().frozen = condition;
  return *this;
}

EventProblem& EventProblem::flow_set(const std::string& condition, const std::string& say) {
  components_.back().flow_sets.push_back({condition, say});
  return *this;
}

EventProblem& EventProblem::state(const std::string& name, expr::Shape shape,
                                  const std::string& start) {
  State& state = states_.emplace_back();
  state.variable.name = name;
  state.variable.shape = shape;
  state.variable.component = components_.size() - 1;
  state.start = start;
  return *this;
}

EventProblem& EventProblem::symmetric(const std::string& name, int size, const std::string& start) {
  state(name, {size, size}, start);
  states_.back().variable.structure = model::Structure::symmetric;
  return *this;
}

EventProblem& EventProblem::mode(const std::string& name, const std::string& start) {
  state(name, {}, start);
  states_.back().variable.kind = VariableKind::mode;
  return *this;
}

EventProblem& EventProblem::flow(const std::string& name, const std::string& text) {
  flows_.emplace_back(name, text);
  return *this;
}

EventProblem& EventProblem::number(VariableKind kind, const std::string& name,
                                   const std::string& event) {
  state(name, {}, "");
  states_.back().variable.kind = kind;
  states_.back().of = event;
  return *this;
}

EventProblem& EventProblem::noise(const std::string& name, Dynamics::NoiseKind kind,
                                  const std::vector<std::string>& values, const std::string& event,
                                  const std::string& every) {
  noise_.push_back({name, kind, values, event, every});
  return *this;
}

EventProblem& EventProblem::when(const std::string& name, const std::string& condition) {
  events_.push_back({name, EventKind::when, {condition}, "", "", 0, {}});
  return *this;
}

EventProblem& EventProblem::crossing(EventKind kind, const std::string& name,
                                     const std::string& e) {
  events_.push_back({name, kind, {e}, "", "", 0, {}});
  return *this;
}

EventProblem& EventProblem::every(const std::string& name, const std::string& low,
                                  const std::string& high, const std::string& first) {
  events_.push_back({name, EventKind::every, {low, high}, first, "", 0, {}});
  return *this;
}

EventProblem& EventProblem::at(const std::string& name, const std::vector<std::string>& times) {
  events_.push_back({name, EventKind::at, times, "", "", 0, {}});
  return *this;
}

EventProblem& EventProblem::only_if(const std::string& condition) {
  events_.back().only_if = condition;
  return *this;
}

EventProblem& EventProblem::lost(double probability, std::optional<int> in_a_row) {
  events_.back().lost = probability;
  events_.back().in_a_row = in_a_row;
  return *this;
}

EventProblem& EventProblem::jump(const std::string& event, const Map& map) {
  jumps_.push_back({event, components_.size() - 1, map, false, "", "", false});
  return *this;
}

EventProblem& EventProblem::repeat(const std::string& event, const Map& map,
                                   const std::string& until, const std::string& at_most,
                                   bool go_on) {
  jumps_.push_back({event, components_.size() - 1, map, true, until, at_most, go_on});
  return *this;
}

hybrid::System EventProblem::system() const {
  return hybrid::make_system(EventCompiler(*this).compile(), values_);
}

numbers::Matrix part_of(const hybrid::System& system, const Eigen::VectorXd& values,
                        const std::string& variable) {
  const hybrid::Slot& slot = system.layout.slots[system.slot(variable).value()];
  return values.segment(slot.offset, slot.shape.size()).reshaped(slot.shape.rows, slot.shape.cols);
}

numbers::Matrix value_at(const hybrid::System& system, const hybrid::Trajectory& trajectory,
                         const std::string& variable, double t) {
  for (const auto& part : trajectory.parts)
    if (const auto* piece = std::get_if<hybrid::FlowPiece>(&part))
      for (const hybrid::DenseStep& step : piece->steps)
        if (step.from <= t && t <= step.to) return part_of(system, step(t), variable);
  throw std::logic_error("the run has ended before " + std::to_string(t));
}

std::vector<hybrid::JumpPoint> jumps_of(const hybrid::Trajectory& trajectory) {
  std::vector<hybrid::JumpPoint> jumps;
  for (const auto& part : trajectory.parts)
    if (const auto* jump = std::get_if<hybrid::JumpPoint>(&part)) jumps.push_back(*jump);
  return jumps;
}

}  // namespace gainsmith::tests
