#include "packs/pack_graph.h"

#include <algorithm>
#include <stdexcept>

#include "expr/binding/derivative.h"

namespace gainsmith::packs {

using hybrid::Slot;
using hybrid::Switch;
using model::Dynamics;
using numbers::TracedMatrix;
using VariableKind = Dynamics::VariableKind;

/// Element (i, j), i < j, of a symmetric state is kept in element (j, i). Rows are what moves:
/// clocks, states with a flow, and costs with one.
PackGraph::PackGraph(const hybrid::System& system, const std::vector<RunningCost>& costs)
    : system_(&system), costs_(&costs) {
  for (int k = 0; k < static_cast<int>(system.whole); ++k) kept_.push_back(k);
  const auto& variables = system.dynamics.variables;
  std::vector<bool> moves(variables.size(), false);
  for (std::size_t i = 0; i < variables.size(); ++i) {
    const VariableKind kind = variables[i].kind;
    moves[i] =
        kind == VariableKind::time || kind == VariableKind::since || kind == VariableKind::left;
    if (variables[i].structure != model::Structure::symmetric) continue;
    const Slot& slot = system.layout.slots[i];
    const int first = static_cast<int>(slot.offset);
    const int n = slot.shape.rows;
    for (int column = 0; column < n; ++column)
      for (int row = 0; row < column; ++row)
        kept_[index(first + column * n + row)] = first + row * n + column;
  }
  for (const Dynamics::Assignment& assignment : system.dynamics.flow)
    moves[assignment.variable] = true;
  for (std::size_t i = 0; i < variables.size(); ++i) {
    if (!moves[i]) continue;
    const Slot& slot = system.layout.slots[i];
    for (int k = 0; k < slot.shape.size(); ++k) {
      const int element = static_cast<int>(slot.offset) + k;
      if (kept(element) == element) rows_.push_back(element);
    }
  }
  for (const RunningCost& cost : costs)
    if (cost.flow != nullptr) rows_.push_back(static_cast<int>(cost.element));
}

Nodes PackGraph::inputs() {
  Nodes x;
  for (int k = 0; k < static_cast<int>(system_->whole); ++k) x.push_back(graph_.input(kept(k)));
  complete(x);
  return x;
}

numbers::TracedInput PackGraph::at(const Nodes& x, const Nodes* rates) {
  return [this, &x, rates](const expr::Input& input) {
    const auto slot = system_->slot(input.name);
    if (!slot) {
      const auto constant = system_->constants.find(input.name);
      if (constant == system_->constants.end())
        throw std::logic_error("no value for the input " + input.name);
      return numbers::traced(constant->second, graph_);
    }
    const auto first = static_cast<std::size_t>(system_->layout.slots[*slot].offset);
    const auto size = index(input.shape.size());
    TracedMatrix made{input.shape, {}};
    const auto from = static_cast<std::ptrdiff_t>(first);
    const auto to = static_cast<std::ptrdiff_t>(first + size);
    made.value.assign(x.begin() + from, x.begin() + to);
    if (rates != nullptr && std::any_of(rates->begin() + from, rates->begin() + to,
                                        [this](int node) { return !graph_.is_zero(node); }))
      made.slopes.emplace_back(rates->begin() + from, rates->begin() + to);
    return made;
  };
}

TracedMatrix PackGraph::value(const expr::Program& program, const Nodes& x) {
  return numbers::trace(program, at(x, nullptr), graph_);
}

/// Forward differentiation in the one direction f(x): value and v'(x) f(x) by one trace.
TracedMatrix PackGraph::moving(const expr::Program& program, const Nodes& x, const Nodes& rates) {
  // The rate of a rate: a jacobian that moves has no slope, its formula has one.
  TracedMatrix made = numbers::trace(expr::with_derivatives(program), at(x, &rates), graph_);
  if (made.slopes.empty()) made.slopes.emplace_back(made.value.size(), graph_.constant(0));
  return made;
}

/// Truth as arithmetic: `and` is the product of 0 and 1, `not` is 1 - a, and `or` follows from both
/// by De Morgan's rule. So no lane branches.
int PackGraph::truth(const expr::Condition& condition, const Nodes& x) {
  using Is = expr::Condition::Kind;
  const int one = graph_.constant(1);
  const int zero = graph_.constant(0);
  if (condition.is_comparison()) {
    int all = one;
    for (const int d : value(condition.difference, x).value) {
      int holds = graph_.where(condition.kind == Is::positive, d, one, zero);
      if (condition.kind == Is::zero)
        holds = graph_.multiply(holds, graph_.where(false, graph_.negate(d), one, zero));
      all = graph_.multiply(all, holds);
    }
    return all;
  }
  if (condition.kind == Is::none) return graph_.subtract(one, truth(condition.parts.front(), x));
  const bool any = condition.kind == Is::any;
  int product = one;
  for (const expr::Condition& part : condition.parts) {
    const int holds = truth(part, x);
    product = graph_.multiply(product, any ? graph_.subtract(one, holds) : holds);
  }
  return any ? graph_.subtract(one, product) : product;
}

void PackGraph::complete(Nodes& x) {
  for (std::size_t k = 0; k < kept_.size(); ++k) x[k] = x[index(kept_[k])];
  const int up = graph_.constant(1);
  const int down = graph_.constant(-1);
  for (const Switch& one : system_->switches) {
    if (one.kind != Switch::Kind::kink) continue;
    const std::size_t slot = *system_->slot(one.input);
    const auto first = static_cast<std::size_t>(system_->layout.slots[slot].offset);
    const Nodes difference = value(one.difference, x).value;
    for (std::size_t e = 0; e < difference.size(); ++e)
      x[first + e] = graph_.where(false, difference[e], up, down);
  }
}

/// f(x): 1 for the time and for `since`, -1 for `left`, 0 for what rests. The rate of a symmetric
/// state is the symmetric part (F + F')/2 of its flow. A component that is frozen has the rate 0.
Nodes PackGraph::rates(const Nodes& x) {
  const int zero = graph_.constant(0);
  Nodes rates(x.size(), zero);
  const auto& variables = system_->dynamics.variables;
  for (std::size_t i = 0; i < variables.size(); ++i) {
    const auto at = static_cast<std::size_t>(system_->layout.slots[i].offset);
    const VariableKind kind = variables[i].kind;
    if (kind == VariableKind::time || kind == VariableKind::since) rates[at] = graph_.constant(1);
    if (kind == VariableKind::left) rates[at] = graph_.constant(-1);
  }
  for (const Dynamics::Assignment& assignment : system_->dynamics.flow) {
    const Slot& slot = system_->layout.slots[assignment.variable];
    const auto first = static_cast<std::size_t>(slot.offset);
    Nodes value = this->value(assignment.value.program, x).value;
    const auto& frozen =
        system_->dynamics.components[variables[assignment.variable].component].frozen;
    if (frozen && variables[assignment.variable].kind == VariableKind::state) {
      const int is_frozen = truth(*frozen, x);
      for (int& node : value) node = graph_.where(true, is_frozen, zero, node);
    }
    const auto rows = index(slot.shape.rows);
    for (std::size_t k = 0; k < value.size(); ++k) {
      const auto element = static_cast<int>(first + k);
      if (kept(element) == element &&
          variables[assignment.variable].structure == model::Structure::symmetric) {
        const int mirror = value[(k % rows) * rows + k / rows];
        rates[first + k] = graph_.multiply(graph_.constant(0.5), graph_.add(value[k], mirror));
        if (mirror == value[k]) rates[first + k] = value[k];
      } else {
        rates[first + k] = value[k];
      }
    }
  }
  for (const RunningCost& cost : *costs_)
    if (cost.flow != nullptr) rates[cost.element] = value(*cost.flow, x).value[0];
  for (std::size_t k = 0; k < kept_.size(); ++k) rates[k] = rates[index(kept_[k])];
  return rates;
}

}  // namespace gainsmith::packs
