// Internal to numbers: the derivatives of functions of numbers (expr/binding/partial_derivative.h)
// as graphs, and their values over any kind of number.
#pragma once

#include <cstddef>
#include <vector>

#include "numbers/graph/scalar_operations.h"

namespace gainsmith::numbers {

/// The inputs are the operands of the function.
struct PartialGraph {
  ScalarGraph graph;
  int result = -1;
};

/// It is made once.
const PartialGraph& partial_graph(expr::Op op, std::size_t k);

/// The value at operands a, b; not a number where there is none.
template <class S>
S value_of(const PartialGraph& partial, const S& a, const S& b) {
  std::vector<S> values;
  const auto at = [&](int node) {
    return node < 0 ? S(0) : values[static_cast<std::size_t>(node)];
  };
  for (const ScalarGraph::Node& node : partial.graph.nodes()) {
    if (node.op == ScalarOp::input)
      values.push_back(node.a == 0 ? a : b);
    else if (node.op == ScalarOp::constant)
      values.push_back(S(partial.graph.value(static_cast<int>(values.size()))));
    else
      values.push_back(ScalarOperations<S>::apply(node.op, at(node.a), at(node.b), at(node.c)));
  }
  return values[static_cast<std::size_t>(partial.result)];
}

}  // namespace gainsmith::numbers
