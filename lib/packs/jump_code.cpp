#include "packs/jump_code.h"

#include <algorithm>

#include "packs/pack_graph.h"

namespace gainsmith::packs {

using lanes::LaneCode;
using model::Dynamics;
using numbers::ScalarGraph;
using numbers::ScalarOp;

/// x+ = g(x) for all reactions of the event, each from the values before. A symmetric state becomes
/// (X + X')/2. Counters of jumps rise by 1, and the jump cost is evaluated before the jump.
LaneCode jump_code(const PackSystem& pack, std::size_t event, bool lost) {
  const Dynamics& dynamics = pack.system->dynamics;
  PackGraph texts(*pack.system, pack.costs);
  ScalarGraph& graph = texts.graph();
  const Nodes before = texts.inputs();
  Nodes after = before;
  Nodes parts;
  const auto offset = [&](std::size_t variable) {
    return static_cast<std::size_t>(pack.system->layout.slots[variable].offset);
  };
  for (const Dynamics::Reaction& reaction : dynamics.reactions) {
    if (reaction.event != event) continue;
    if (lost && dynamics.components[reaction.component].observer) continue;
    Nodes own = before;
    for (const Dynamics::Pass& pass : reaction.passes) {
      std::vector<Nodes> results;
      for (const Dynamics::Assignment& assignment : pass.map)
        results.push_back(texts.value(assignment.value.program, own).value);
      for (std::size_t k = 0; k < results.size(); ++k) {
        const Dynamics::Variable& variable = dynamics.variables[pass.map[k].variable];
        Nodes& value = results[k];
        if (variable.kind == Dynamics::VariableKind::mode)
          parts.push_back(graph.subtract(value[0], graph.apply(ScalarOp::floor, value[0])));
        if (variable.structure == model::Structure::symmetric) {
          const auto rows = index(variable.shape.rows);
          const Nodes full = value;
          for (std::size_t e = 0; e < full.size(); ++e) {
            const int mirror = full[(e % rows) * rows + e / rows];
            if (mirror != full[e])
              value[e] = graph.multiply(graph.constant(0.5), graph.add(full[e], mirror));
          }
        }
        std::copy(value.begin(), value.end(),
                  own.begin() + static_cast<std::ptrdiff_t>(offset(pass.map[k].variable)));
      }
    }
    for (const Dynamics::Pass& pass : reaction.passes)
      for (const Dynamics::Assignment& assignment : pass.map) {
        const std::size_t first = offset(assignment.variable);
        const auto size = index(dynamics.variables[assignment.variable].shape.size());
        std::copy_n(own.begin() + static_cast<std::ptrdiff_t>(first), size,
                    after.begin() + static_cast<std::ptrdiff_t>(first));
      }
  }
  for (std::size_t i = 0; i < dynamics.variables.size(); ++i) {
    const Dynamics::Variable& variable = dynamics.variables[i];
    using Kind = Dynamics::VariableKind;
    int& node = after[offset(i)];
    if (variable.kind == Kind::jumps || (variable.kind == Kind::count && variable.of == event))
      node = graph.add(before[offset(i)], graph.constant(1));
    if (variable.kind == Kind::passes && variable.of == event) node = graph.constant(0);
  }
  for (const RunningCost& cost : pack.costs)
    if (cost.jump != nullptr)
      after[cost.element] =
          graph.add(before[cost.element], texts.value(*cost.jump, before).value[0]);
  return {graph, {after, parts}, pack.whole};
}

}  // namespace gainsmith::packs
