// The syntax tree of an expression, before names and shapes are known.
#pragma once

#include <cstddef>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "expr/text/text.h"

namespace gainsmith::expr {

enum class NodeKind {
  number,  ///< text = the decimal as written
  name,    ///< text = the name
  call,    ///< text = the function or definition; children = arguments
  index,   ///< children[0] indexed by the rest; a `range` child is a:b or a lone ":"
  range,   ///< children = {from, to}, or none for ":"
  negate,
  transpose,
  add,
  subtract,
  multiply,
  divide,
  power,
  elementwise_multiply,
  elementwise_divide,
  elementwise_power,
  block,        ///< children row by row, `columns` in each row
  mirror,       ///< "*" inside a block: the transpose of the mirrored entry
  each,         ///< "i in a..b" in a sum: text = the index, children = {from, to}
  within,       ///< "x in [a, b]" in a maximum: text = the name, children = {a, b}
  compare,      ///< children = operands of a chain a < b <= c; relations between them
  conjunction,  ///< "and" between conditions
  disjunction,  ///< "or"
  negation      ///< "not"
};

/// not_equal occurs in conditions and between whole numbers only.
enum class Relation { less, less_equal, greater, greater_equal, equal, not_equal };

/// "<", "<=", ">", ">=", "==", "!=".
std::string to_string(Relation relation);

/// One node of a tree. Nodes are shared and never changed once the tree is made.
struct Node {
  NodeKind kind = NodeKind::number;
  std::string text;
  std::vector<std::shared_ptr<const Node>> children;
  /// Of `compare`, one less than children.
  std::vector<Relation> relations;
  /// Of `block`: the entries in a row.
  int columns = 0;
  int height = 1;         ///< of the tree: 1 for a leaf
  std::size_t begin = 0;  ///< first byte in the Text
  std::size_t end = 0;    ///< one past the last byte
};

using NodePtr = std::shared_ptr<const Node>;

/// A parsed expression together with its text, for messages.
struct Expression {
  std::shared_ptr<const Text> text;
  NodePtr root;

  /// The source of a node, shortened to be quoted in a message.
  std::string quote(const Node& node) const;
  Place place(const Node& node) const { return text->place(node.begin); }
};

/// The conditions that 'and' joins, in order; of another expression itself.
std::vector<Expression> conjuncts(const Expression& expression);

/// The names of values, functions and definitions that occur in an expression.
std::set<std::string> names_in(const Expression& expression);

}  // namespace gainsmith::expr
