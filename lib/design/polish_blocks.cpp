#include "design/polish_blocks.h"

namespace gainsmith::design {

SmoothBlocks smooth_blocks(const model::Instance& instance) {
  const lmi::Lmi lmi = lmi::compile(instance);
  const model::SynthesisOptions& choices = instance.problem->synthesis;
  SmoothBlocks result;
  result.bounds = lmi::gain_bounds(instance, lmi.unknowns, choices.gain_bound);
  lmi::Goal goal = lmi::goal_of(lmi, result.bounds);
  if (goal == lmi::Goal::feasibility) goal = lmi::Goal::certificate;
  result.shifts = lmi::formulate(lmi, result.bounds, choices, goal).shifts;
  result.list = lmi.blocks;
  result.list.insert(result.list.end(), result.bounds.blocks.begin(), result.bounds.blocks.end());
  result.shifts.resize(result.list.size(), 0.0);
  result.unknowns = lmi.unknowns.size() + result.bounds.scalars;
  if (lmi.has_objective) {
    result.cost = lmi.objective;
    result.cost.resize(static_cast<std::size_t>(result.unknowns), 0.0);
    result.constant = lmi.objective_constant;
  }
  return result;
}

std::vector<double> packed(const model::Instance& instance, const SmoothBlocks& blocks,
                           const model::Gains& gains) {
  const lmi::Unknowns unknowns(instance);
  std::vector<double> x(static_cast<std::size_t>(blocks.unknowns), 0.0);
  for (const lmi::Unknown& unknown : unknowns.list()) {
    const numbers::Matrix* matrix = gains.find(unknown.name);
    if (matrix == nullptr) throw NoProgram{unknown.name + " has no value"};
    for (int k = 0; k < unknown.count; ++k) {
      const auto [row, column] = unknown.places(k).front();
      x[static_cast<std::size_t>(unknown.first + k - 1)] = (*matrix)(row, column);
    }
  }
  for (const lmi::GainBound& bound : blocks.bounds.list) {
    if (bound.scalar == 0) continue;
    numbers::Matrix s = numbers::Matrix::Zero(bound.s.shape.rows, bound.s.shape.cols);
    for (const auto& [key, coefficient] : bound.s.terms)
      s += (key.second == 0 ? 1.0 : x[static_cast<std::size_t>(key.second) - 1]) *
           numbers::Matrix(coefficient);
    x[static_cast<std::size_t>(bound.scalar) - 1] = lmi::smallest_eigenvalue(s);
  }
  return x;
}

}  // namespace gainsmith::design
