// e^(A s) of a known matrix A and a number s as nodes of a scalar graph:
//
//   e^(A s) = sum_i C_i f_i(s),   f_i = s^m e^(a s) cos(b s)  or  s^m e^(a s) sin(b s)
//
// over the eigenvalues a + b i of A, m below their multiplicity. The C_i, n x n, follow from
// (d/ds)^k e^(A s) = A^k at s = 0, k = 0 .. n-1, in 31 digits.
#pragma once

#include <optional>
#include <vector>

#include "numbers/graph/scalar_graph.h"
#include "numbers/matrix.h"

namespace gainsmith::numbers {

/// A square matrix whose elements are all multiples of one number.
struct Multiple {
  Matrix factor;
  int number = -1;  ///< the node s; of constants the node 1
};

/// rows^2 nodes, column by column, as factor * s, with no other factors than constants; none where
/// they are multiples of different nodes.
std::optional<Multiple> as_multiple(const std::vector<int>& nodes, int rows, ScalarGraph& graph);

/// The nodes of e^(A s), column by column. None where the sum would lose more than three digits
/// (eigenvalues that nearly coincide), and of large A.
std::optional<std::vector<int>> exponential_nodes(const Multiple& argument, ScalarGraph& graph);

}  // namespace gainsmith::numbers
