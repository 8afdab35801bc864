#include "packs/moves.h"

#include <set>

namespace gainsmith::packs {

/// States that rest along flows and that some jump map assigns.
std::vector<std::size_t> set_by_jumps(const hybrid::System& system) {
  using model::Dynamics;
  std::set<std::size_t> elements;
  for (const Dynamics::Reaction& reaction : system.dynamics.reactions)
    for (const Dynamics::Pass& pass : reaction.passes)
      for (const Dynamics::Assignment& assignment : pass.map) {
        const Dynamics::Variable& variable = system.dynamics.variables[assignment.variable];
        const bool flows = system.moves[assignment.variable] != hybrid::Moves::rests;
        if (variable.kind != Dynamics::VariableKind::state || flows) continue;
        const auto first =
            static_cast<std::size_t>(system.layout.slots[assignment.variable].offset);
        for (int k = 0; k < variable.shape.size(); ++k)
          elements.insert(first + static_cast<std::size_t>(k));
      }
  return {elements.begin(), elements.end()};
}

}  // namespace gainsmith::packs
