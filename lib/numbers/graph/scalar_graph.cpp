#include "numbers/graph/scalar_graph.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "numbers/graph/scalar_operations.h"

namespace gainsmith::numbers {

double apply(ScalarOp op, double a, double b, double c) {
  return ScalarOperations<double>::apply(op, a, b, c);
}

/// Multiplicative hashing of each part by 2^64 over the golden ratio.
std::size_t ScalarGraph::Hash::operator()(const Key& key) const {
  std::uint64_t hash = 0;
  for (const int part : key) {
    hash ^= static_cast<std::uint32_t>(part);
    hash *= 0x9e3779b97f4a7c15U;
    hash ^= hash >> 32;
  }
  return static_cast<std::size_t>(hash);
}

/// Numbers rise in the order of making: nodes and blocks from the mark on go, with their entries in
/// the tables. The values of their constants stay in constants_, where no node reads them.
void ScalarGraph::return_to(Mark mark) {
  const auto is_later = [&](const auto& known) { return known.second >= mark.nodes; };
  std::erase_if(known_, is_later);
  std::erase_if(known_constants_, is_later);
  std::erase_if(known_blocks_, [&](const auto& known) { return known.second >= mark.blocks; });
  nodes_.resize(index(mark.nodes));
  blocks_.resize(index(mark.blocks));
}

/// Constants are told apart by their bits: 0 and -0 are two.
int ScalarGraph::constant(double value) {
  const auto [found, fresh] = known_constants_.emplace(std::bit_cast<std::uint64_t>(value),
                                                       static_cast<int>(nodes_.size()));
  if (fresh) {
    nodes_.push_back({ScalarOp::constant, static_cast<int>(constants_.size()), -1, -1});
    constants_.push_back(value);
  }
  return found->second;
}

/// The node with this operation and these operands; made where there is none.
int ScalarGraph::node(const Node& made) {
  const Key key{static_cast<int>(made.op), made.a, made.b, made.c};
  const auto [found, fresh] = known_.emplace(key, static_cast<int>(nodes_.size()));
  if (fresh) nodes_.push_back(made);
  return found->second;
}

int ScalarGraph::folded(const Node& made) {
  const auto known = [&](int at) { return at < 0 || is_constant(at); };
  if (known(made.a) && known(made.b) && known(made.c)) {
    const auto number = [&](int at) { return at < 0 ? 0 : value(at); };
    const double result = numbers::apply(made.op, number(made.a), number(made.b), number(made.c));
    // What has no finite value stays an operation, so that its fault is found in a run.
    if (std::isfinite(result)) return constant(result);
  }
  return node(made);
}

/// 0 + b = b, a + (-b) = a - b. Operands of sums and products are kept in rising order, since equal
/// nodes are found by their order too.
int ScalarGraph::add(int a, int b) {
  if (is_zero(a)) return b;
  if (is_zero(b)) return a;
  if (nodes_[index(b)].op == ScalarOp::negate) return subtract(a, nodes_[index(b)].a);
  return folded({ScalarOp::add, std::min(a, b), std::max(a, b), -1});
}

int ScalarGraph::subtract(int a, int b) {
  if (is_zero(b)) return a;
  if (is_zero(a)) return negate(b);
  if (nodes_[index(b)].op == ScalarOp::negate) return add(a, nodes_[index(b)].a);
  return folded({ScalarOp::subtract, a, b, -1});
}

/// 0 b = 0, 1 b = b, -1 b = -b.
int ScalarGraph::multiply(int a, int b) {
  if (is_zero(a)) return a;
  if (is_zero(b)) return b;
  for (const auto& [one, other] : {std::pair(a, b), std::pair(b, a)}) {
    if (is_constant(one) && value(one) == 1) return other;
    if (is_constant(one) && value(one) == -1) return negate(other);
  }
  return folded({ScalarOp::multiply, std::min(a, b), std::max(a, b), -1});
}

int ScalarGraph::divide(int a, int b) {
  if (is_constant(b) && value(b) == 1) return a;
  return folded({ScalarOp::divide, a, b, -1});
}

int ScalarGraph::negate(int a) {
  if (nodes_[index(a)].op == ScalarOp::negate) return nodes_[index(a)].a;
  return folded({ScalarOp::negate, a, -1, -1});
}

int ScalarGraph::where(bool strict, int difference, int b, int c) {
  if (b == c) return b;
  if (is_constant(difference)) {
    const double d = value(difference);
    return (strict ? d > 0 : d >= 0) ? b : c;
  }
  return node({strict ? ScalarOp::where_positive : ScalarOp::where_nonnegative, difference, b, c});
}

int ScalarGraph::apply(ScalarOp op, int a, int b) { return folded({op, a, b, -1}); }

bool ScalarGraph::is_partial(int at) const {
  const Node& node = nodes_[index(at)];
  switch (node.op) {
    case ScalarOp::divide:
      return !is_constant(node.b) || value(node.b) == 0;
    case ScalarOp::real_power:
    case ScalarOp::mod:
    case ScalarOp::exp:
    case ScalarOp::log:
    case ScalarOp::sqrt:
      return true;
    default:
      return false;
  }
}

/// Equal blocks have the same operation, attributes, body and operands; the numbers of rows tell
/// apart shapes with the same elements. The nodes of a result follow each other, column by column.
int ScalarGraph::block(Block block) {
  const expr::Instruction& instruction = block.instruction;
  std::vector<int> heights;
  for (const expr::Shape& shape : block.shapes) heights.push_back(shape.rows);
  heights.push_back(instruction.shape.rows);
  const BlockKey key{instruction.op,         block.is_slope,
                     instruction.attributes, bodies_.number_of(instruction.body),
                     block.operands,         std::move(heights)};
  const auto [found, fresh] = known_blocks_.emplace(key, static_cast<int>(blocks_.size()));
  if (!fresh) return blocks_[index(found->second)].first;
  block.first = static_cast<int>(nodes_.size());
  for (int k = 0; k < instruction.shape.size(); ++k)
    nodes_.push_back({ScalarOp::element, found->second, -1, -1});
  blocks_.push_back(std::move(block));
  return blocks_.back().first;
}

}  // namespace gainsmith::numbers
