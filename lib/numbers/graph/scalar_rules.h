// Internal to numbers: what the values and the derivatives of traced programs (scalar_trace.h) are
// made of.
#pragma once

#include <optional>
#include <vector>

#include "numbers/graph/scalar_trace.h"

namespace gainsmith::numbers {

using Nodes = std::vector<int>;
using TracedOperands = std::vector<const TracedMatrix*>;

/// Thrown: a derivative that has no formula on numbers.
struct NoFormula {};

/// Rules over matrices of nodes, column by column.
class NodeRules {
 public:
  explicit NodeRules(ScalarGraph& graph) : graph_(graph) {}

  int zero() { return graph_.constant(0); }
  int number(double value) { return graph_.constant(value); }
  Nodes zeros(expr::Shape shape) { return Nodes(static_cast<std::size_t>(shape.size()), zero()); }
  /// The place of an element, column by column.
  static std::size_t at(expr::Shape shape, int row, int column) {
    return static_cast<std::size_t>(column) * static_cast<std::size_t>(shape.rows) +
           static_cast<std::size_t>(row);
  }

  /// What is linear in all operands: so values and slopes are. `nodes`: of each operand, its values
  /// or slopes; `scale` by a number that does not move is among them. False: it is none of these.
  bool linear(const expr::Instruction& instruction, const TracedOperands& in,
              const std::vector<const Nodes*>& nodes, Nodes& out);
  /// A B, column by column; products with the constant 0 are left out. None where more than 4096
  /// terms are left: that is better a block.
  std::optional<Nodes> product(expr::Shape left, const Nodes& a, expr::Shape right, const Nodes& b);
  /// A^exponent, exponent >= 0, by squaring; none as product().
  std::optional<Nodes> matrix_power(expr::Shape shape, Nodes square, int exponent);
  /// The same of a number.
  int power(int square, int exponent);
  /// The nodes of a block's result: constants where all operands are.
  Nodes block_of(const ScalarGraph::Block& block);

 protected:
  ScalarGraph& graph_;

 private:
  void blocks(const expr::Instruction& instruction, const TracedOperands& in,
              const std::vector<const Nodes*>& nodes, Nodes& out);
  std::optional<Nodes> folded(const ScalarGraph::Block& block);
};

/// What a derivative is for.
enum class Derivative {
  jacobian,  ///< a value of a program: a root has none at 0
  rate       ///< the rate of a value: that of a root at 0 is 0, as of an error that stays 0
};

/// The derivative of an instruction in direction d, where its value `out` has a formula. NoFormula
/// where the derivative has none.
Nodes slope(ScalarGraph& graph, const expr::Instruction& instruction, const TracedOperands& in,
            std::size_t d, const TracedMatrix& out, Derivative kind);

}  // namespace gainsmith::numbers
