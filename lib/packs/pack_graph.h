// Texts of a System as nodes of a scalar graph over all its values.
//
// A symmetric state is its lower triangle: elements above the diagonal are the nodes of those
// below. The branch of a kink of a flow (abs, max, min) is taken from its sign; those of `where`
// and `sign` are inputs.
#pragma once

#include <vector>

#include "expr/binding/condition.h"
#include "hybrid/system.h"
#include "numbers/graph/scalar_trace.h"

namespace gainsmith::packs {

using Nodes = std::vector<int>;

inline std::size_t index(int at) { return static_cast<std::size_t>(at); }

/// The cost of a claim so far, as one of the values: c' = flow, c+ = c + jump.
struct RunningCost {
  std::size_t element = 0;
  const expr::Program* flow = nullptr;  ///< nullptr: 0
  const expr::Program* jump = nullptr;  ///< of all events, before their jumps; nullptr: 0
};

/// Traces programs into one graph of numbers. The values of the system are numbered as in its
/// layout, `whole` of them; a matrix is kept column by column.
class PackGraph {
 public:
  /// The system and the costs must outlive it.
  PackGraph(const hybrid::System& system, const std::vector<RunningCost>& costs);

  numbers::ScalarGraph& graph() { return graph_; }
  /// The inputs: one node for each of the values, in their order; behind them others may follow.
  Nodes inputs();
  /// An input behind those of the values, the k-th from 0.
  int beside(int k) { return graph_.input(static_cast<int>(system_->whole) + k); }

  /// The nodes of a program at values x, and of its rate where all values have the rates `rates`.
  /// NoFormula (numbers/graph/scalar_rules.h) where it has none.
  numbers::TracedMatrix value(const expr::Program& program, const Nodes& x);
  numbers::TracedMatrix moving(const expr::Program& program, const Nodes& x, const Nodes& rates);
  /// 1 where a condition is true, otherwise 0.
  int truth(const expr::Condition& condition, const Nodes& x);

  /// The elements that change in a flow: clocks, costs, and states with one; of symmetric states
  /// those on and below the diagonal.
  const std::vector<int>& rows() const { return rows_; }
  /// Of all values; 0 where nothing moves.
  Nodes rates(const Nodes& x);
  /// Sets kinks, and what mirrors another element.
  void complete(Nodes& x);
  /// The element that an element is kept in.
  int kept(int element) const { return kept_[static_cast<std::size_t>(element)]; }

 private:
  numbers::TracedInput at(const Nodes& x, const Nodes* rates);

  const hybrid::System* system_;
  const std::vector<RunningCost>* costs_;
  numbers::ScalarGraph graph_;
  std::vector<int> kept_;
  std::vector<int> rows_;
};

}  // namespace gainsmith::packs
