// A scalar graph as one list of operations on registers: the inputs, the constants, then one for
// each operation, in the order of the graph. What no result needs is left out, but for what may
// have no value. A product that is needed by one sum alone is computed with it.
#pragma once

#include <cstdint>
#include <vector>

#include "numbers/scalar_graph.h"

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
  };

  std::vector<Step> steps;
  std::vector<Block> blocks;
  std::vector<std::vector<std::uint32_t>> results;
  std::vector<std::uint32_t> reads;  ///< the inputs that are used
  std::vector<double> constants;     ///< of the registers behind the inputs
  std::uint32_t inputs = 0;
  std::uint32_t registers = 0;
};

/// What computes the nodes of `results` from `inputs` numbers.
TapeCode tape_code(const ScalarGraph& graph, const std::vector<std::vector<int>>& results,
                   int inputs);

}  // namespace gainsmith::numbers
