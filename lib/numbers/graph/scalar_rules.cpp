#include "numbers/graph/scalar_rules.h"

#include <numeric>
#include <utility>

#include "numbers/graph/tape_block.h"
#include "numbers/types/shared_rules.h"

namespace gainsmith::numbers {

namespace {

using expr::Instruction;
using expr::Op;
using expr::Shape;

/// A product of matrices with more terms is a block.
constexpr int kMostTerms = 4096;

}  // namespace

bool NodeRules::linear(const Instruction& instruction, const TracedOperands& in,
                       const std::vector<const Nodes*>& nodes, Nodes& out) {
  const Shape shape = instruction.shape;
  const auto place = [&](const auto& made) {
    for (int column = 0; column < shape.cols; ++column)
      for (int row = 0; row < shape.rows; ++row) out.push_back(made(row, column));
    return true;
  };
  switch (instruction.op) {
    case Op::zeros:
      out = zeros(shape);
      return true;
    case Op::fill:
      return place([&](int, int) { return (*nodes[0])[0]; });
    case Op::identity:
      return place([&](int row, int column) { return row == column ? (*nodes[0])[0] : zero(); });
    case Op::negate:
      for (const int node : *nodes[0]) out.push_back(graph_.negate(node));
      return true;
    case Op::scale:
      for (const int node : *nodes[1]) out.push_back(graph_.multiply(in[0]->value[0], node));
      return true;
    case Op::transpose:
      return place([&](int row, int column) { return (*nodes[0])[at(in[0]->shape, column, row)]; });
    case Op::index:
      return place([&](int row, int column) {
        return (*nodes[0])[at(in[0]->shape, instruction.attributes[0] + row,
                              instruction.attributes[2] + column)];
      });
    case Op::blocks:
      blocks(instruction, in, nodes, out);
      return true;
    case Op::trace: {
      int sum = zero();
      for (int k = 0; k < in[0]->shape.rows; ++k)
        sum = graph_.add(sum, (*nodes[0])[at(in[0]->shape, k, k)]);
      out = {sum};
      return true;
    }
    case Op::diagonal_matrix:
      return place([&](int row, int column) {
        return row == column ? (*nodes[0])[static_cast<std::size_t>(row)] : zero();
      });
    case Op::diagonal_of:
      return place([&](int row, int) { return (*nodes[0])[at(in[0]->shape, row, row)]; });
    default:
      return false;
  }
}

/// [A, B; C, D], row of blocks by row of blocks, with attributes[0] operands in each.
void NodeRules::blocks(const Instruction& instruction, const TracedOperands& in,
                       const std::vector<const Nodes*>& nodes, Nodes& out) {
  out = zeros(instruction.shape);
  const auto columns = static_cast<std::size_t>(instruction.attributes[0]);
  int row = 0;
  for (std::size_t first = 0; first < in.size(); first += columns) {
    int column = 0;
    for (std::size_t j = first; j < first + columns; ++j) {
      const Shape part = in[j]->shape;
      for (int c = 0; c < part.cols; ++c)
        for (int r = 0; r < part.rows; ++r)
          out[at(instruction.shape, row + r, column + c)] = (*nodes[j])[at(part, r, c)];
      column += part.cols;
    }
    row += in[first]->shape.rows;
  }
}

/// C_ij = sum_k A_ik B_kj. The terms other than 0 are counted first: a large product is one step of
/// a tape, as a block, where it would be thousands.
std::optional<Nodes> NodeRules::product(Shape left, const Nodes& a, Shape right, const Nodes& b) {
  int terms = 0;
  for (int row = 0; row < left.rows; ++row)
    for (int k = 0; k < left.cols; ++k) {
      if (graph_.is_zero(a[at(left, row, k)])) continue;
      for (int column = 0; column < right.cols; ++column)
        terms += graph_.is_zero(b[at(right, k, column)]) ? 0 : 1;
    }
  if (terms > kMostTerms) return std::nullopt;
  Nodes result;
  for (int column = 0; column < right.cols; ++column)
    for (int row = 0; row < left.rows; ++row) {
      int sum = zero();
      for (int k = 0; k < left.cols; ++k)
        sum = graph_.add(sum, graph_.multiply(a[at(left, row, k)], b[at(right, k, column)]));
      result.push_back(sum);
    }
  return result;
}

/// The product of the squares A^(2^k) over the binary digits of the exponent that are 1.
std::optional<Nodes> NodeRules::matrix_power(Shape shape, Nodes square, int exponent) {
  Nodes result = zeros(shape);
  for (int k = 0; k < shape.rows; ++k) result[at(shape, k, k)] = number(1);
  for (; exponent > 0; exponent /= 2) {
    if (exponent % 2 == 1) {
      auto next = product(shape, result, shape, square);
      if (!next) return std::nullopt;
      result = std::move(*next);
    }
    if (exponent == 1) break;
    auto next = product(shape, square, shape, square);
    if (!next) return std::nullopt;
    square = std::move(*next);
  }
  return result;
}

/// The value of an operation on constants. Where there is none, its fault is to be detected later.
std::optional<Nodes> NodeRules::folded(const ScalarGraph::Block& block) {
  TapeCode::Block code{block.instruction, {}, block.shapes, block.is_slope};
  std::vector<double> values;
  for (const Nodes& operand : block.operands) {
    code.operands.emplace_back();
    for (const int node : operand) {
      if (!graph_.is_constant(node)) return std::nullopt;
      code.operands.back().push_back(static_cast<std::uint32_t>(values.size()));
      values.push_back(graph_.value(node));
    }
  }
  TapeBlock operation(code);
  const Matrix* const result = operation(values.data());
  if (result == nullptr || !result->allFinite()) return std::nullopt;
  Nodes nodes;
  for (const double value : result->reshaped()) nodes.push_back(graph_.constant(value));
  return nodes;
}

/// The nodes of a result have numbers in a row, from the first on.
Nodes NodeRules::block_of(const ScalarGraph::Block& block) {
  if (auto known = folded(block)) return std::move(*known);
  Nodes nodes(static_cast<std::size_t>(block.instruction.shape.size()));
  std::iota(nodes.begin(), nodes.end(), graph_.block(block));
  return nodes;
}

int NodeRules::power(int square, int exponent) {
  return whole_power(number(1), square, exponent,
                     [&](int a, int b) { return graph_.multiply(a, b); });
}

}  // namespace gainsmith::numbers
