#include "claims/independence.h"

#include <optional>

namespace gainsmith::claims {

namespace {

using model::Dynamics;
using VariableKind = Dynamics::VariableKind;

class Reads {
 public:
  Reads(const Dynamics& dynamics, std::vector<bool>& variables)
      : dynamics_(dynamics), variables_(variables) {}

  void add(const expr::Program& program) {
    for (const expr::Input& input : program.inputs)
      for (std::size_t k = 0; k < variables_.size(); ++k)
        if (dynamics_.variables[k].name == input.name) variables_[k] = true;
  }
  void add(const std::optional<model::Formula>& formula) {
    if (formula) add(formula->program);
  }
  void add(const expr::Condition& condition) {
    if (condition.is_comparison()) add(condition.difference);
    for (const expr::Condition& part : condition.parts) add(part);
  }
  void add(const std::optional<expr::Condition>& condition) {
    if (condition) add(*condition);
  }

 private:
  const Dynamics& dynamics_;
  std::vector<bool>& variables_;
};

/// Whether a jump of the event changes it besides its maps.
bool is_of_event(const Dynamics& dynamics, const Dynamics::Variable& variable, std::size_t event) {
  switch (variable.kind) {
    case VariableKind::count:
    case VariableKind::since:
    case VariableKind::passes:
    case VariableKind::left:
      return variable.of == event;
    case VariableKind::noise:
      return dynamics.noise[variable.of].event == event;
    default:
      return false;
  }
}

bool any_of_both(const std::vector<bool>& a, const std::vector<bool>& b) {
  for (std::size_t k = 0; k < a.size(); ++k)
    if (a[k] && b[k]) return true;
  return false;
}

}  // namespace

std::vector<bool> read_by_guards(const Dynamics& dynamics, std::size_t event) {
  std::vector<bool> variables(dynamics.variables.size());
  Reads reads(dynamics, variables);
  const Dynamics::Event& one = dynamics.events[event];
  reads.add(one.condition);
  reads.add(one.crossing);
  reads.add(one.only_if);
  return variables;
}

Independence::Independence(const Dynamics& dynamics) {
  const std::size_t variables = dynamics.variables.size();
  for (std::size_t event = 0; event < dynamics.events.size(); ++event) {
    Touched& touched =
        events_.emplace_back(read_by_guards(dynamics, event), std::vector<bool>(variables));
    Reads reads(dynamics, touched.reads);
    for (const Dynamics::Reaction& reaction : dynamics.reactions) {
      if (reaction.event != event) continue;
      for (const Dynamics::Pass& pass : reaction.passes) {
        reads.add(pass.until);
        for (const Dynamics::Assignment& assignment : pass.map) {
          reads.add(assignment.value.program);
          touched.writes[assignment.variable] = true;
        }
      }
    }
    for (std::size_t k = 0; k < variables; ++k) {
      if (is_of_event(dynamics, dynamics.variables[k], event)) touched.writes[k] = true;
      const bool of_all = dynamics.variables[k].kind == VariableKind::jumps;
      touched.counts_jumps = touched.counts_jumps || (of_all && touched.reads[k]);
    }
  }
}

bool Independence::operator()(std::size_t one, std::size_t other) const {
  const Touched& a = events_[one];
  const Touched& b = events_[other];
  const auto is_apart = [](const Touched& from, const Touched& to) {
    return !any_of_both(from.writes, to.reads);
  };
  return !a.counts_jumps && !b.counts_jumps && is_apart(a, b) && is_apart(b, a) &&
         !any_of_both(a.writes, b.writes);
}

}  // namespace gainsmith::claims
