#include "verify/error_states.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "expr/rewrite.h"
#include "model/dynamics_programs.h"

namespace gainsmith::verify {

using expr::Program;
using hybrid::System;
using model::Dynamics;

namespace {

bool uses(const Program& program, const std::string& name) {
  return std::any_of(program.inputs.begin(), program.inputs.end(),
                     [&](const expr::Input& input) { return input.name == name; });
}

Dynamics::Assignment* assignment_of(Dynamics::Reaction& reaction, std::size_t variable) {
  for (Dynamics::Pass& pass : reaction.passes)
    for (Dynamics::Assignment& one : pass.map)
      if (one.variable == variable) return &one;
  return nullptr;
}

/// Whether a reaction that changes the variable has a single map.
bool is_simple(const Dynamics& dynamics, std::size_t variable, bool may_be_lost) {
  return std::all_of(dynamics.reactions.begin(), dynamics.reactions.end(),
                     [&](Dynamics::Reaction reaction) {
                       if (assignment_of(reaction, variable) == nullptr) return true;
                       return reaction.passes.size() == 1 && !reaction.passes.front().repeats &&
                              (may_be_lost || dynamics.events[reaction.event].lost == 0);
                     });
}

/// Whether a state flows and jumps in such a way that a difference with it can.
bool is_plain(const Dynamics& dynamics, std::size_t variable, bool may_be_lost) {
  const Dynamics::Variable& one = dynamics.variables[variable];
  return one.kind == Dynamics::VariableKind::state &&
         one.structure != model::Structure::symmetric &&
         !dynamics.components[one.component].frozen && is_simple(dynamics, variable, may_be_lost);
}

/// The dynamics of a system with flows as written, before their branches are held.
Dynamics as_written(const System& system) {
  Dynamics dynamics = system.dynamics;
  for (std::size_t f = 0; f < dynamics.flow.size(); ++f)
    if (system.free_flow[f]) dynamics.flow[f].value.program = *system.free_flow[f];
  return dynamics;
}

Program zeros(expr::Shape shape) {
  expr::Composer compose({});
  return compose.take(compose.apply(expr::Op::zeros, {}, shape));
}

}  // namespace

std::optional<ErrorStates> ErrorStates::of(const System& system,
                                           const std::vector<Program>& functions) {
  std::vector<bounded::StateDifference> differences =
      bounded::find_differences(functions, system.layout);
  std::erase_if(differences, [&](const bounded::StateDifference& one) {
    return !is_plain(system.dynamics, *system.slot(one.plus), false) ||
           !is_plain(system.dynamics, *system.slot(one.minus), true);
  });
  while (!differences.empty()) {
    ErrorStates result(system, differences);
    const auto bound = result.first_bound();
    if (!bound) return result;
    differences.erase(differences.begin() + static_cast<std::ptrdiff_t>(*bound));
  }
  return std::nullopt;
}

ErrorStates::ErrorStates(const System& system, std::vector<bounded::StateDifference> differences)
    : differences_(std::move(differences)),
      rewriting_(differences_, system.layout),
      dynamics_(as_written(system)) {
  dynamics_.signals.clear();
  for (const bounded::StateDifference& one : differences_)
    places_.push_back({*system.slot(one.plus), *system.slot(one.minus)});
  find_flows();
  find_jumps();
  model::for_each_run_program(
      dynamics_, [&](Program& program, const gainsmith::Place&) { program = (*this)(program); });
  for (std::size_t k = 0; k < places_.size(); ++k)
    dynamics_.variables[places_[k].minus].name = differences_[k].name;
}

Program ErrorStates::operator()(const Program& program) {
  const bool reads = std::any_of(differences_.begin(), differences_.end(),
                                 [&](const auto& one) { return uses(program, one.minus); });
  return reads ? rewriting_(program) : program;
}

/// The flow of b becomes f_a - f_b.
void ErrorStates::find_flows() {
  const auto flow_of = [&](std::size_t variable) {
    return std::find_if(dynamics_.flow.begin(), dynamics_.flow.end(),
                        [&](const auto& one) { return one.variable == variable; });
  };
  const std::vector<Dynamics::Assignment> written = dynamics_.flow;
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const auto rate = [&](std::size_t variable) {
      for (const Dynamics::Assignment& one : written)
        if (one.variable == variable) return one.value.program;
      return zeros(differences_[k].shape);
    };
    const auto a = flow_of(places_[k].plus);
    if (a == dynamics_.flow.end() && flow_of(places_[k].minus) == dynamics_.flow.end()) continue;
    if (flow_of(places_[k].minus) == dynamics_.flow.end())
      dynamics_.flow.push_back({places_[k].minus, a->value, a->place});
    flow_of(places_[k].minus)->value.program =
        bounded::difference(rate(places_[k].plus), rate(places_[k].minus));
  }
}

/// The map of b becomes a+ - b+, also where a alone jumps.
void ErrorStates::find_jumps() {
  const Dynamics written = dynamics_;
  for (std::size_t e = 0; e < written.events.size(); ++e)
    for (std::size_t k = 0; k < places_.size(); ++k) {
      const auto after = [&](std::size_t variable) -> std::optional<Dynamics::Assignment> {
        for (Dynamics::Reaction reaction : written.reactions)
          if (reaction.event == e)
            if (const auto* found = assignment_of(reaction, variable)) return *found;
        return std::nullopt;
      };
      const auto plus = after(places_[k].plus);
      const auto minus = after(places_[k].minus);
      if (!plus && !minus) continue;
      const auto value = [&](const auto& found, const std::string& name) {
        return found ? found->value.program : bounded::input_program(name, differences_[k].shape);
      };
      Dynamics::Assignment& own = map_of(e, places_[k].minus, plus ? *plus : *minus);
      own.value.program = bounded::difference(value(plus, differences_[k].plus),
                                              value(minus, differences_[k].minus));
    }
}

/// The assignment of a variable in the reaction of its component; made where there is none.
Dynamics::Assignment& ErrorStates::map_of(std::size_t event, std::size_t variable,
                                          const Dynamics::Assignment& like) {
  const std::size_t component = dynamics_.variables[variable].component;
  const auto found = std::find_if(
      dynamics_.reactions.begin(), dynamics_.reactions.end(),
      [&](const auto& one) { return one.event == event && one.component == component; });
  if (found == dynamics_.reactions.end()) {
    Dynamics::Pass pass;
    pass.map.push_back({variable, like.value, like.place});
    pass.place = like.place;
    dynamics_.reactions.push_back({event, component, {pass}, like.place});
    return dynamics_.reactions.back().passes.front().map.front();
  }
  if (Dynamics::Assignment* own = assignment_of(*found, variable)) return *own;
  found->passes.front().map.push_back({variable, like.value, like.place});
  return found->passes.front().map.back();
}

std::optional<std::size_t> ErrorStates::first_bound() const {
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const auto is_bound = [&](const Dynamics::Assignment& one) {
      return one.variable == places_[k].minus && uses(one.value.program, differences_[k].plus);
    };
    if (std::any_of(dynamics_.flow.begin(), dynamics_.flow.end(), is_bound)) return k;
    for (const Dynamics::Reaction& reaction : dynamics_.reactions)
      for (const Dynamics::Pass& pass : reaction.passes)
        if (std::any_of(pass.map.begin(), pass.map.end(), is_bound)) return k;
  }
  return std::nullopt;
}

void ErrorStates::rewrite(hybrid::Scenario& scenario) const {
  std::map<std::string, Program> names;
  for (const bounded::StateDifference& one : differences_)
    names[one.minus] = bounded::input_program(one.name, one.shape);
  for (auto& rule : scenario.starts)
    if (rule && rule->kind == model::StartKind::expression)
      rule->program = bounded::replace_inputs(rule->program, names);
  for (const Place& one : places_) scenario.differences.emplace_back(one.minus, one.plus);
}

}  // namespace gainsmith::verify
