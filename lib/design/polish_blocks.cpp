#include "design/polish_blocks.h"

#include "numbers/dense.h"

namespace gainsmith::design {

SmoothBlocks smooth_blocks(const model::Instance& instance) {
  const lmi::Inequalities inequalities(instance);
  const lmi::Lmi lmi = lmi::compile(inequalities);
  const model::SynthesisOptions& choices = instance.design->synthesis;
  SmoothBlocks result;
  result.layout = inequalities.unknowns;
  result.bounds = lmi::gain_bounds(inequalities, choices.gain_bound);
  lmi::Goal goal = lmi::goal_of(lmi, result.bounds);
  if (goal == lmi::Goal::feasibility) goal = lmi::Goal::certificate;
  result.shifts = lmi::formulate(lmi, result.bounds, choices, goal).shifts;
  result.list = lmi.blocks;
  result.list.insert(result.list.end(), result.bounds.blocks.begin(), result.bounds.blocks.end());
  result.shifts.resize(result.list.size(), 0.0);
  result.unknowns = lmi.unknowns + result.bounds.scalars;
  if (lmi.has_objective) {
    result.cost = lmi.objective;
    result.cost.resize(static_cast<std::size_t>(result.unknowns), 0.0);
    result.constant = lmi.objective_constant;
  }
  return result;
}

std::vector<double> packed(const SmoothBlocks& blocks, const model::Gains& gains) {
  std::vector<double> x(static_cast<std::size_t>(blocks.unknowns), 0.0);
  for (const lmi::Unknown& unknown : blocks.layout.list()) {
    const numbers::Matrix* matrix = gains.find(unknown.name);
    if (matrix == nullptr) throw NotSmooth{unknown.name + " has no value"};
    for (int k = 0; k < unknown.count; ++k) {
      const auto [row, column] = unknown.places(k).front();
      x[static_cast<std::size_t>(unknown.first + k - 1)] = (*matrix)(row, column);
    }
  }
  for (const lmi::BoundedProduct& bound : blocks.bounds.list) {
    if (bound.scalar == 0) continue;
    x[static_cast<std::size_t>(bound.scalar) - 1] =
        numbers::smallest_eigenvalue(lmi::value_of(bound.s, x));
  }
  return x;
}

}  // namespace gainsmith::design
