#include "verify/error_states.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "base/named.h"
#include "hybrid/state_layout.h"
#include "linear/differences.h"
#include "model/dynamics_programs.h"

namespace gainsmith::verify {

using expr::Program;
using model::Dynamics;

namespace {

bool uses(const Program& program, const std::string& name) {
  return has_named(program.inputs, name);
}

/// What a reaction assigns to a variable; nullptr: nothing.
Dynamics::Assignment* assignment_of(Dynamics::Reaction& reaction, std::size_t variable) {
  for (Dynamics::Pass& pass : reaction.passes)
    for (Dynamics::Assignment& assignment : pass.map)
      if (assignment.variable == variable) return &assignment;
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

/// Whether a state flows and jumps such that a difference with it can.
bool is_plain(const Dynamics& dynamics, std::size_t variable, bool may_be_lost) {
  const Dynamics::Variable& one = dynamics.variables[variable];
  return one.kind == Dynamics::VariableKind::state &&
         one.structure != model::Structure::symmetric &&
         !dynamics.components[one.component].frozen && is_simple(dynamics, variable, may_be_lost);
}

Program zeros(expr::Shape shape) {
  expr::Composer compose({});
  return compose.take(compose.apply(expr::Op::zeros, {}, shape));
}

using Differences = std::vector<linear::StateDifference>;

/// Dynamics with differences as states.
class ErrorStates {
 public:
  ErrorStates(const Dynamics& dynamics, const hybrid::StateLayout& layout,
              const Differences& differences)
      : differences_(differences), rewriting_(differences, layout), dynamics_(dynamics) {
    dynamics_.signals.clear();
    for (const linear::StateDifference& difference : differences_)
      places_.push_back({*layout.slot(difference.plus), *layout.slot(difference.minus)});
    find_flows();
    find_jumps();
    model::for_each_run_program(
        dynamics_, [&](Program& program, const gainsmith::Place&) { rewrite(program); });
    for (std::size_t k = 0; k < places_.size(); ++k)
      dynamics_.variables[places_[k].minus].name = differences_[k].name;
  }

  /// The first difference that does not move by itself.
  std::optional<std::size_t> first_bound() const;
  model::RunTexts rewritten(model::RunTexts texts);

 private:
  struct Place {
    std::size_t plus = 0, minus = 0;  ///< of a and b among the variables
  };

  void rewrite(Program& program);
  void find_flows();
  void find_jumps();
  Dynamics::Assignment& map_of(std::size_t event, std::size_t variable,
                               const Dynamics::Assignment& like);

  const Differences& differences_;
  std::vector<Place> places_;
  linear::ErrorRewriting rewriting_;
  Dynamics dynamics_;
};

/// b = a - d where the text reads b, with equal terms cancelled.
void ErrorStates::rewrite(Program& program) {
  const bool reads = std::any_of(differences_.begin(), differences_.end(),
                                 [&](const auto& one) { return uses(program, one.minus); });
  if (reads) program = rewriting_(program);
}

/// The flow of b becomes f_a - f_b.
void ErrorStates::find_flows() {
  const auto flow_of = [&](std::size_t variable) {
    return std::ranges::find(dynamics_.flow, variable, &Dynamics::Assignment::variable);
  };
  const std::vector<Dynamics::Assignment> written = dynamics_.flow;
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const auto rate = [&](std::size_t variable) {
      for (const Dynamics::Assignment& assignment : written)
        if (assignment.variable == variable) return assignment.value.program;
      return zeros(differences_[k].shape);
    };
    const auto a = flow_of(places_[k].plus);
    if (a == dynamics_.flow.end() && flow_of(places_[k].minus) == dynamics_.flow.end()) continue;
    if (flow_of(places_[k].minus) == dynamics_.flow.end())
      dynamics_.flow.push_back({places_[k].minus, a->value, a->place});
    flow_of(places_[k].minus)->value.program =
        linear::difference(rate(places_[k].plus), rate(places_[k].minus));
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
        return found ? found->value.program : expr::input_program(name, differences_[k].shape);
      };
      Dynamics::Assignment& own = map_of(e, places_[k].minus, plus ? *plus : *minus);
      own.value.program = linear::difference(value(plus, differences_[k].plus),
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

/// A difference whose d' or d+ reads a.
std::optional<std::size_t> ErrorStates::first_bound() const {
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const auto is_bound = [&](const Dynamics::Assignment& assignment) {
      return assignment.variable == places_[k].minus &&
             uses(assignment.value.program, differences_[k].plus);
    };
    if (std::any_of(dynamics_.flow.begin(), dynamics_.flow.end(), is_bound)) return k;
    for (const Dynamics::Reaction& reaction : dynamics_.reactions)
      for (const Dynamics::Pass& pass : reaction.passes)
        if (std::any_of(pass.map.begin(), pass.map.end(), is_bound)) return k;
  }
  return std::nullopt;
}

/// b = a - d in claims; where runs start the place of d still holds b.
model::RunTexts ErrorStates::rewritten(model::RunTexts texts) {
  std::map<std::string, Program> names;
  for (const linear::StateDifference& difference : differences_)
    names[difference.minus] = expr::input_program(difference.name, difference.shape);
  const auto rename = [&](Program& start) { start = linear::replace_inputs(start, names); };
  texts.dynamics = std::move(dynamics_);
  for (Dynamics::Variable& variable : texts.dynamics.variables)
    if (variable.start) rename(variable.start->program);
  for (model::Design::Start& start : texts.campaign.starts)
    if (start.kind == model::StartKind::expression) rename(start.values.front().program);
  for (model::Design::Claim& claim : texts.claims) {
    rewrite(claim.value.program);
    for (auto* part : {&claim.flow_cost, &claim.jump_cost, &claim.factor, &claim.bound})
      if (*part) rewrite((*part)->program);
  }
  for (const Place& place : places_) texts.differences.emplace_back(place.minus, place.plus);
  return texts;
}

}  // namespace

std::optional<model::RunTexts> with_error_states(const model::RunTexts& texts,
                                                 const std::vector<Program>& functions) {
  const hybrid::StateLayout layout = hybrid::layout_of(texts.dynamics);
  Differences differences = linear::find_differences(functions, layout);
  std::erase_if(differences, [&](const linear::StateDifference& difference) {
    return !is_plain(texts.dynamics, *layout.slot(difference.plus), false) ||
           !is_plain(texts.dynamics, *layout.slot(difference.minus), true);
  });
  while (!differences.empty()) {
    ErrorStates states(texts.dynamics, layout, differences);
    const auto bound = states.first_bound();
    if (!bound) return states.rewritten(texts);
    differences.erase(differences.begin() + static_cast<std::ptrdiff_t>(*bound));
  }
  return std::nullopt;
}

}  // namespace gainsmith::verify
