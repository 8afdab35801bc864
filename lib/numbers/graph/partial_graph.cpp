#include "numbers/graph/partial_graph.h"

#include <map>
#include <string>
#include <utility>

#include "expr/binding/partial_derivative.h"
#include "numbers/graph/scalar_trace.h"

namespace gainsmith::numbers {

namespace {

using Key = std::pair<expr::Op, std::size_t>;

std::map<Key, PartialGraph> make_all() {
  std::map<Key, PartialGraph> graphs;
  for (const expr::NumberFunction& function : expr::kNumberFunctions) {
    for (std::size_t k = 0; k < function.derivatives.size(); ++k) {
      if (function.derivatives[k].empty()) continue;
      PartialGraph& partial = graphs[{function.op, k}];
      const auto input = [&](const expr::Input& operand) -> TracedMatrix {
        return {operand.shape, {partial.graph.input(std::stoi(operand.name))}};
      };
      const expr::Program& program = expr::partial_derivative(function.op, k);
      partial.result = trace(program, input, partial.graph).value[0];
    }
  }
  return graphs;
}

}  // namespace

const PartialGraph& partial_graph(expr::Op op, std::size_t k) {
  static const std::map<Key, PartialGraph> all = make_all();
  return all.at({op, k});
}

}  // namespace gainsmith::numbers
