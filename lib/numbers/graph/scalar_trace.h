// Programs as nodes of a scalar graph.
//
// Other libraries may rely on this: evaluating the nodes of a result gives the value of the program
// over Real, to rounding, wherever the program has one.
//
// The rules are those of Real, element by element; derivatives (Op::jacobian) are those of Dual,
// whose slopes are nodes too. What has no formula on numbers is one block: decompositions of
// matrices, projections, flow_map, extremum, and derivatives of these (block_slope.h).
#pragma once

#include <functional>
#include <vector>

#include "expr/program/program.h"
#include "numbers/graph/scalar_graph.h"
#include "numbers/types/real.h"

namespace gainsmith::numbers {

/// Nodes of a matrix, column by column.
struct TracedMatrix {
  expr::Shape shape;
  std::vector<int> value;
  /// By direction the nodes of its derivative; empty: it does not move.
  std::vector<std::vector<int>> slopes{};

  bool moves() const { return !slopes.empty(); }
};

/// What replaces an input.
using TracedInput = std::function<TracedMatrix(const expr::Input&)>;

/// The result of a program without calls.
TracedMatrix trace(const expr::Program& program, const TracedInput& input, ScalarGraph& graph);

/// The nodes of a known matrix.
TracedMatrix traced(const Matrix& value, ScalarGraph& graph);

}  // namespace gainsmith::numbers
