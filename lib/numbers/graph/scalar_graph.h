// Operations on single numbers as a directed graph without equal nodes (common subexpressions are
// one node, by hashing). What is known is folded: sums with 0, products with 0 and 1, operations on
// constants.
//
// Other libraries may rely on this: a node comes after the nodes that it reads, and its number does
// not change until return_to(). The graph holds no operation "of tapes alone". A block has its
// operands and its result column by column.
//
// A product with the constant 0 is 0, whatever the other factor is; but what may have no value
// (is_partial) stays, so that its fault is detected.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <unordered_map>
#include <vector>

#include "expr/program/program.h"

namespace gainsmith::numbers {

enum class ScalarOp : std::uint8_t {
  input,     ///< number `a` of the stacked inputs
  constant,  ///< number `a` of the constants
  element,   ///< of the result of block `a`
#define SCALAR_OP(op, operands, ...) op,
#include "numbers/graph/scalar_ops.def"
  block  ///< number `a` of the blocks; of tapes alone
};

/// The operation on doubles; operands that it does not have are not read. std::logic_error for
/// input, constant, element and block.
double apply(ScalarOp op, double a, double b, double c);

class ScalarGraph {
 public:
  struct Node {
    ScalarOp op = ScalarOp::constant;
    int a = -1, b = -1, c = -1;  ///< nodes before it, or as ScalarOp says
  };
  /// An operation on matrices whose operands and result are nodes, column by column.
  struct Block {
    expr::Instruction instruction;
    std::vector<std::vector<int>> operands;
    std::vector<expr::Shape> shapes;  ///< of the operands
    /// Its derivative in a direction: the second half of the operands are the slopes of the first.
    /// Of a flow map: its value and its derivative in all directions (flow_map_evaluator.h).
    bool is_slope = false;
    int first = 0;  ///< node of its result; the others follow
  };

  /// Each returns the number of its node: a new one, one like it, or one that it simplifies to.
  int input(int position) { return node({ScalarOp::input, position, -1, -1}); }
  int constant(double value);
  int add(int a, int b);
  int subtract(int a, int b);
  int multiply(int a, int b);
  int divide(int a, int b);
  int negate(int a);
  /// b where the node `difference` is > 0 (`strict`) or >= 0, otherwise c.
  int where(bool strict, int difference, int b, int c);
  /// Any other operation on one or two nodes; folded where they are constants.
  int apply(ScalarOp op, int a, int b = -1);
  /// The first node of the result, unless there is one like it.
  int block(Block block);

  /// What is there, to come back to: what was added since is forgotten.
  struct Mark {
    int nodes = 0, blocks = 0;
  };
  Mark mark() const { return {static_cast<int>(nodes_.size()), static_cast<int>(blocks_.size())}; }
  void return_to(Mark mark);

  bool is_constant(int at) const { return nodes_[index(at)].op == ScalarOp::constant; }
  bool is_zero(int at) const { return is_constant(at) && value(at) == 0; }
  /// Of a constant.
  double value(int at) const { return constants_[index(nodes_[index(at)].a)]; }
  /// Whether it may have no value, or none that is finite, where its operands have.
  bool is_partial(int at) const;

  const std::vector<Node>& nodes() const { return nodes_; }
  const std::vector<Block>& blocks() const { return blocks_; }

 private:
  using Key = std::array<int, 4>;
  struct Hash {
    std::size_t operator()(const Key& key) const;
  };
  struct BlockKey {
    expr::Op op;
    bool is_slope;
    expr::Attributes attributes;
    int body;
    std::vector<std::vector<int>> operands;
    std::vector<int> heights;  ///< of the operands, then of the result
    auto operator<=>(const BlockKey&) const = default;
  };

  static std::size_t index(int at) { return static_cast<std::size_t>(at); }
  int node(const Node& node);
  /// The constant that it is, if its operands are and it has a value.
  int folded(const Node& node);

  std::vector<Node> nodes_;
  std::vector<double> constants_;
  std::vector<Block> blocks_;
  std::unordered_map<Key, int, Hash> known_;
  std::unordered_map<std::uint64_t, int> known_constants_;  ///< by their bits
  std::map<BlockKey, int> known_blocks_;
  expr::Bodies bodies_;
};

}  // namespace gainsmith::numbers
