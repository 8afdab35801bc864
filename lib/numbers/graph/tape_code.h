// A scalar graph as one list of operations on registers: the inputs, the constants, then one for
// each operation, in the order of the graph. What no result needs is left out; what may have no
// value is not, if it is asked for. A product that is needed by one sum alone is computed with it.
#pragma once

#include <cstdint>
#include <vector>

#include "numbers/graph/scalar_graph.h"

namespace gainsmith::numbers {

struct TapeCode {
  /// Registers out <- op(a, b, c). A block: `a` is its number, `out` the first of its results.
  struct Step {
    ScalarOp op;
    std::uint32_t out, a, b, c;
  };
  struct Block {
    expr::Instruction instruction;
    std::vector<std::vector<std::uint32_t>> operands;  ///< registers, column by column
    std::vector<expr::Shape> shapes;                   ///< of the operands
    bool is_slope = false;                             ///< as of ScalarGraph::Block
  };

  std::vector<Step> steps;
  std::vector<Block> blocks;
  std::vector<std::vector<std::uint32_t>> results;
  std::vector<std::uint32_t> reads;  ///< the inputs that are used
  std::vector<double> constants;     ///< of the registers behind the inputs
  std::uint32_t inputs = 0;
  std::uint32_t registers = 0;
};

enum class Computed {
  partial,  ///< what results need, and all that may have no value
  needed    ///< what results need
};

/// What computes the nodes of `results` from `inputs` numbers.
TapeCode tape_code(const ScalarGraph& graph, const std::vector<std::vector<int>>& results,
                   int inputs, Computed computed = Computed::partial);

}  // namespace gainsmith::numbers
