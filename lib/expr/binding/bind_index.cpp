// Parts of matrices, and whole numbers that are known before anything is computed.
#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <optional>
#include <utility>

#include "expr/binding/binder.h"

namespace gainsmith::expr {

namespace {

std::optional<int> as_int(std::int64_t value) {
  constexpr std::int64_t kMost = std::numeric_limits<int>::max();
  return std::abs(value) <= kMost ? std::optional(static_cast<int>(value)) : std::nullopt;
}

/// A decimal without point and exponent; none for others and for those beyond int.
std::optional<int> whole(const std::string& decimal) {
  int value = 0;
  const auto end = std::from_chars(decimal.data(), decimal.data() + decimal.size(), value);
  const bool complete = end.ec == std::errc() && end.ptr == decimal.data() + decimal.size();
  return complete ? std::optional(value) : std::nullopt;
}

/// a + b, a - b or a b; none where it is no int.
std::optional<int> combined(Op op, std::optional<std::int64_t> a, std::optional<std::int64_t> b) {
  if (!a || !b) return std::nullopt;
  if (op == Op::add) return as_int(*a + *b);
  return as_int(op == Op::subtract ? *a - *b : *a * *b);
}

}  // namespace

/// Indices, sizes and exponents must be known before shapes are. They are computed from the syntax
/// tree, without a program.
std::optional<int> Binder::whole_number(const Expression& expression, const Node& node) {
  if (node.kind == NodeKind::negate) {
    const auto value = whole_number(expression, *node.children[0]);
    return value ? std::optional<int>(-*value) : std::nullopt;
  }
  if (node.kind == NodeKind::number) return whole(node.text);
  if (node.kind == NodeKind::name) {
    if (node.text == kEnd && !ends_.empty()) return ends_.back();
    if (const auto found = environment_.find(node.text); found != environment_.end())
      return found->second.identity ? std::nullopt : whole_value(found->second.at);
    if (scope_.symbols.contains(node.text) || scope_.definitions.contains(node.text))
      return std::nullopt;
    const auto found = scope_.dimensions.find(node.text);
    return found == scope_.dimensions.end() ? std::nullopt : std::optional<int>(found->second);
  }
  if (node.kind == NodeKind::call && node.text == "rank")
    return whole_value(bind(expression, node).at);
  const auto op = node.kind == NodeKind::add        ? std::optional(Op::add)
                  : node.kind == NodeKind::subtract ? std::optional(Op::subtract)
                  : node.kind == NodeKind::multiply ? std::optional(Op::multiply)
                                                    : std::nullopt;
  if (!op) return std::nullopt;
  return combined(*op, whole_number(expression, *node.children[0]),
                  whole_number(expression, *node.children[1]));
}

/// Of an instruction: what replaces a parameter of a definition, or an index.
std::optional<int> Binder::whole_value(int at) const {
  const Instruction& instruction = assembly_[at];
  const auto operand = [&](std::size_t i) { return whole_value(instruction.operands[i]); };
  if (instruction.op == Op::constant) return whole(instruction.text);
  if (instruction.op == Op::negate) {
    const auto value = operand(0);
    return value ? std::optional<int>(-*value) : std::nullopt;
  }
  const bool arithmetic =
      instruction.op == Op::add || instruction.op == Op::subtract || instruction.op == Op::multiply;
  if (!arithmetic || !instruction.shape.is_scalar()) return std::nullopt;
  return combined(instruction.op, operand(0), operand(1));
}

std::optional<int> Binder::whole_index(const Expression& expression, const Node& node, int end) {
  ends_.push_back(end);
  const auto value = whole_number(expression, node);
  ends_.pop_back();
  return value;
}

/// From 1 to `size` as in the language, [first, last) from 0 in the result. a:a-1 is empty.
std::pair<int, int> Binder::index_range(const Expression& expression, const Node& whole,
                                        const Node& node, int size) {
  if (node.kind == NodeKind::range && node.children.empty()) return {0, size};
  const bool range = node.kind == NodeKind::range;
  const Node& from_node = range ? *node.children[0] : node;
  const Node& to_node = range ? *node.children[1] : node;
  const auto from = whole_index(expression, from_node, size);
  const auto to = whole_index(expression, to_node, size);
  if (!from || !to) {
    const Node& unknown = from ? to_node : from_node;
    const bool of_time = names_in({expression.text, std::make_shared<Node>(unknown)}).contains("t");
    fail(expression, unknown,
         std::string("an index must be a whole number known beforehand") +
             (of_time ? "; a value at another time is a delay, which 'flow' does not have: see "
                        "'Delays' in docs/dynamics.md"
                      : ""));
  }
  const bool empty = range && *to == *from - 1;
  if (*from < 1 || *to > size || (*from > *to && !empty))
    fail(expression, node,
         "the index " + expression.quote(node) + " is outside 1:" + std::to_string(size) + " in " +
             expression.quote(whole));
  return {*from - 1, *to};
}

/// One index of a row or a column, two of any matrix.
Bound Binder::index(const Expression& expression, const Node& node, Bound base, std::size_t first) {
  if (base.is_system()) refuse_system(expression, node);
  const int at = sized(expression, node, base);
  const Shape from = shape(at);
  const std::size_t count = node.children.size() - first;
  std::pair<int, int> rows{0, from.rows};
  std::pair<int, int> cols{0, from.cols};
  if (count == 1 && (from.cols == 1 || from.rows == 1)) {
    auto& range = from.cols == 1 ? rows : cols;
    range = index_range(expression, node, *node.children[first], from.size());
  } else if (count == 2) {
    rows = index_range(expression, node, *node.children[first], from.rows);
    cols = index_range(expression, node, *node.children[first + 1], from.cols);
  } else {
    fail(expression, node,
         "a " + to_string(from) + " matrix takes two indices, not " + std::to_string(count) +
             (count == 1 ? "; one of several matrices is that of a family, 'for: i in 1..N'" : ""));
  }
  return {emit(expression, node, Op::index, {at},
               {rows.second - rows.first, cols.second - cols.first},
               {rows.first, rows.second, cols.first, cols.second})};
}

}  // namespace gainsmith::expr
