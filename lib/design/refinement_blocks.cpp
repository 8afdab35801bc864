#include "design/refinement_blocks.h"

#include <algorithm>

#include "numbers/dense/dense.h"

namespace gainsmith::design {

/// shift_k = margin / u^2 for strict blocks, u the largest unit of a row of the block.
SmoothBlocks smooth_blocks(const model::Instance& instance) {
  const lmi::Inequalities inequalities(instance);
  const lmi::Lmi lmi = lmi::compile(inequalities);
  const model::SynthesisOptions& choices = instance.design->synthesis;
  SmoothBlocks result;
  result.layout = inequalities.unknowns;
  result.bounds = lmi::gain_bounds(inequalities, lmi);
  const lmi::Formulation formulation = lmi::pose_objective(lmi, result.bounds, choices.margin);
  // The shift is that of the row with the smallest: any is enough, since what is found is solved
  // again.
  for (std::size_t k = 0; k < lmi.blocks.size(); ++k) {
    double unit = formulation.balance.row(k, 0);
    for (int r = 1; r < lmi.blocks[k].size; ++r)
      unit = std::max(unit, formulation.balance.row(k, r));
    result.shifts.push_back(lmi.blocks[k].strict ? choices.margin / (unit * unit) : 0.0);
  }
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
  // The largest value of the scalar that the bound's own block allows at these unknowns.
  for (const lmi::BoundedProduct& bound : blocks.bounds.list) {
    if (bound.scalar == 0) continue;
    x[static_cast<std::size_t>(bound.scalar) - 1] =
        numbers::smallest_eigenvalue(lmi::value_of(bound.s, x));
  }
  return x;
}

}  // namespace gainsmith::design
