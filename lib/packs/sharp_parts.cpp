#include "packs/sharp_parts.h"

#include <algorithm>
#include <set>
#include <utility>

#include "packs/pack_graph.h"

namespace gainsmith::packs {

using numbers::ScalarGraph;
using numbers::ScalarOp;

SharpParts::SharpParts(const hybrid::System& system, ScalarGraph& graph) : graph_(graph) {
  is_state_.assign(static_cast<std::size_t>(system.whole), false);
  for (std::size_t i = 0; i < system.layout.slots.size(); ++i) {
    if (system.moves[i] != hybrid::Moves::flows) continue;
    const hybrid::Slot& slot = system.layout.slots[i];
    std::fill_n(is_state_.begin() + slot.offset, slot.shape.size(), true);
  }
}

/// Visits all that a node is made of, itself first.
template <class Visit>
void SharpParts::visit(int node, const Visit& seen_by) const {
  std::set<int> seen;
  std::vector<int> waiting{node};
  while (!waiting.empty()) {
    const int at = waiting.back();
    waiting.pop_back();
    if (at < 0 || !seen.insert(at).second) continue;
    const ScalarGraph::Node operation = graph_.nodes()[index(at)];
    seen_by(operation, at);
    if (operation.op == ScalarOp::input || operation.op == ScalarOp::constant) continue;
    if (operation.op != ScalarOp::element) {
      waiting.insert(waiting.end(), {operation.a, operation.b, operation.c});
      continue;
    }
    for (const auto& operand : graph_.blocks()[index(operation.a)].operands)
      waiting.insert(waiting.end(), operand.begin(), operand.end());
  }
}

/// A norm near 0 bends as sqrt(x) does. Singular values bend where two of them meet; the squares of
/// their differences do not.
std::vector<int> SharpParts::roots(int node) {
  std::vector<int> found;
  visit(node, [&](const ScalarGraph::Node& operation, int) {
    if (operation.op == ScalarOp::sqrt) found.push_back(operation.a);
  });
  for (const int tie : ties(node)) found.push_back(tie);
  return found;
}

/// 0 where singular values of which a node is made are equal, or are 0.
std::vector<int> SharpParts::ties(int node) {
  std::set<std::pair<int, int>> differences;  // of nodes; the second may be -1
  visit(node, [&](const ScalarGraph::Node& operation, int at) {
    if (operation.op != ScalarOp::element) return;
    const ScalarGraph::Block& block = graph_.blocks()[index(operation.a)];
    if (block.instruction.op != expr::Op::singular_values || block.is_slope) return;
    const int last = block.first + block.instruction.shape.size() - 1;
    if (at > block.first) differences.insert({at - 1, at});
    differences.insert({at, at < last ? at + 1 : -1});
  });
  std::vector<int> ties;
  for (const auto& [difference, other] : differences)
    ties.push_back(square(other < 0 ? difference : graph_.subtract(difference, other)));
  return ties;
}

/// Whether a node changes along flows with more than clocks.
bool SharpParts::depends_on_states(int node) const {
  if (node < 0) return false;
  bool depends = false;
  visit(node, [&](const ScalarGraph::Node& operation, int) {
    depends = depends || (operation.op == ScalarOp::input && is_state_[index(operation.a)]);
  });
  return depends;
}

/// Peaks of exp, tanh, log, powers and angles of states, and of quotients by them; not of clocks
/// alone.
std::vector<int> SharpParts::flats(int node) {
  std::vector<std::pair<ScalarGraph::Node, int>> found;
  visit(node, [&](const ScalarGraph::Node& operation, int at) {
    const bool bends = operation.op == ScalarOp::exp || operation.op == ScalarOp::tanh ||
                       operation.op == ScalarOp::log || operation.op == ScalarOp::real_power ||
                       operation.op == ScalarOp::atan2;
    const bool divides = operation.op == ScalarOp::divide;
    if ((bends && depends_on_states(operation.a)) ||
        ((bends || divides) && depends_on_states(operation.b)))
      found.emplace_back(operation, at);
  });
  std::vector<int> flats;
  for (const auto& [operation, at] : found) flats.push_back(flat_beside(operation, at));
  return flats;
}

/// A quantity >= 0 that is small beside its largest value just where the peak is: b^2 of a/b, x^2 +
/// y^2 of the angle of (x, y), x of log x and of x^c, e^x of tanh x, the value itself of e^x.
int SharpParts::flat_beside(const ScalarGraph::Node& operation, int at) {
  switch (operation.op) {
    case ScalarOp::divide:
      return square(operation.b);
    case ScalarOp::atan2:
      return graph_.add(square(operation.a), square(operation.b));
    case ScalarOp::log:
      return operation.a;
    case ScalarOp::real_power:
      return depends_on_states(operation.b) ? at : operation.a;
    case ScalarOp::tanh:
      return graph_.apply(ScalarOp::exp, operation.a);
    default:
      return at;
  }
}

}  // namespace gainsmith::packs
