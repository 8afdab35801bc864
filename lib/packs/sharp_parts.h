// Where the polynomial of a value over a step may miss something: roots near 0, equal singular
// values, and peaks that are narrow beside the step.
#pragma once

#include <vector>

#include "hybrid/system.h"
#include "numbers/graph/scalar_graph.h"

namespace gainsmith::packs {

/// Each result is a node that is never negative where the value exists, and is near 0 beside its
/// largest value where the value bends.
class SharpParts {
 public:
  /// Both must outlive it. The inputs of the graph are the values of the system.
  SharpParts(const hybrid::System& system, numbers::ScalarGraph& graph);

  /// The operands of all square roots that a node is made of; and the squares of the differences of
  /// singular values, which are smooth where the values are equal.
  std::vector<int> roots(int node);
  /// Beside which peaks are: the squares of divisors, exponentials and the like of states.
  std::vector<int> flats(int node);

 private:
  template <class Visit>
  void visit(int node, const Visit& seen_by) const;
  bool depends_on_states(int node) const;
  int square(int node) { return graph_.multiply(node, node); }
  std::vector<int> ties(int node);
  int flat_beside(const numbers::ScalarGraph::Node& one, int at);

  numbers::ScalarGraph& graph_;
  std::vector<bool> is_state_;  ///< by value: whether it flows, and is no clock
};

}  // namespace gainsmith::packs
