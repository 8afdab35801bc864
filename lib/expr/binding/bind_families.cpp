// Names with indices, sums over them, and Kronecker products.
#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/nearest.h"
#include "expr/binding/compile.h"
#include "expr/binding/emitter.h"

namespace gainsmith::expr {

/// The name of a member as a plain symbol.
std::string member_name(const std::string& family, const std::vector<int>& indices) {
  std::string name = family;
  for (const int index : indices) name += "_" + std::to_string(index);
  return name;
}

namespace {

bool compares(Relation relation, int a, int b) {
  switch (relation) {
    case Relation::less:
      return a < b;
    case Relation::less_equal:
      return a <= b;
    case Relation::greater:
      return a > b;
    case Relation::greater_equal:
      return a >= b;
    case Relation::equal:
      return a == b;
    case Relation::not_equal:
      return a != b;
  }
  return false;
}

}  // namespace

/// `what`: "an index of P", "the end of a range", for the message.
int Binder::required_whole_number(const Expression& expression, const Node& node,
                                  const std::string& what) {
  const auto value = whole_number(expression, node);
  const bool is_unknown = node.kind == NodeKind::name && !environment_.contains(node.text) &&
                          !scope_.symbols.contains(node.text) &&
                          !scope_.definitions.contains(node.text);
  if (!value && is_unknown && !scope_.dimensions.empty()) {
    std::vector<std::string> known;
    for (const auto& [name, size] : scope_.dimensions) known.push_back(name);
    fail(expression, node,
         what + " must be a whole number known beforehand: there is no dimension or index '" +
             node.text + "' here" + suggestion(node.text, known) +
             "; an index has its values from 'forall: i in 1..N', from the name of a gain L(i in "
             "1..N), or in sum(i in 1..N, ...)");
  }
  if (!value)
    fail(expression, node,
         what + " must be a whole number known beforehand, not '" + expression.quote(node) +
             "'; an index has its values from 'forall: i in 1..N', from the name of a gain "
             "L(i in 1..N), or in sum(i in 1..N, ...)");
  return *value;
}

/// A range with last < first is empty.
std::pair<int, int> Binder::range_of(const Expression& expression, const Node& low,
                                     const Node& high) {
  constexpr int kFarthest = 1'000'000'000;
  constexpr int kMost = 100'000;
  const int first = required_whole_number(expression, low, "the end of a range");
  const int last = required_whole_number(expression, high, "the end of a range");
  for (const auto& [end, node] : {std::pair(first, &low), std::pair(last, &high)})
    if (end < -kFarthest || end > kFarthest)
      fail(expression, *node, "the end of a range is at most " + std::to_string(kFarthest));
  if (last - first >= kMost)
    fail(expression, high,
         "the range has " + std::to_string(last - first + 1) + " values; an index has at most " +
             std::to_string(kMost));
  return {first, last};
}

/// Indices are whole numbers here, so that a member is a plain name; `end` is the last index.
std::optional<std::string> Binder::member(const Expression& expression, const Node& node) {
  if (node.kind != NodeKind::call || environment_.contains(node.text)) return std::nullopt;
  const auto family = scope_.families.find(node.text);
  if (family == scope_.families.end()) return std::nullopt;
  const Ranges& ranges = family->second;
  if (node.children.size() != ranges.size())
    fail(expression, node,
         "the family " + node.text + " takes " + std::to_string(ranges.size()) + " indices, not " +
             std::to_string(node.children.size()));
  std::vector<int> indices;
  for (std::size_t k = 0; k < ranges.size(); ++k) {
    const Node& child = *node.children[k];
    const auto [low, high] = ranges[k];
    ends_.push_back(high);
    indices.push_back(required_whole_number(expression, child, "an index of " + node.text));
    ends_.pop_back();
    if (indices.back() < low || indices.back() > high)
      fail(expression, child,
           "the family " + node.text + " has the members " + std::to_string(low) + " to " +
               std::to_string(high) + "; found " + std::to_string(indices.back()));
  }
  return member_name(node.text, indices);
}

/// A parameter counts by its value, which may be a mode.
bool Binder::is_over_modes(const Node& node) const {
  switch (node.kind) {
    case NodeKind::name: {
      const auto bound = environment_.find(node.text);
      const Instruction* at = bound == environment_.end() ? nullptr : &assembly_[bound->second.at];
      if (at != nullptr && at->op != Op::input) return false;
      const std::string& name = at == nullptr ? node.text : assembly_.input_name(*at);
      const auto symbol = scope_.symbols.find(name);
      return symbol != scope_.symbols.end() && symbol->second.whole;
    }
    case NodeKind::negate:
    case NodeKind::add:
    case NodeKind::subtract:
    case NodeKind::multiply: {
      const auto is_whole = [](const NodePtr& child) {
        return child->kind == NodeKind::number &&
               child->text.find_first_not_of("0123456789") == std::string::npos;
      };
      const auto over = [&](const NodePtr& child) { return is_over_modes(*child); };
      return std::ranges::any_of(node.children, over) &&
             std::ranges::all_of(node.children, [&](const NodePtr& child) {
               return over(child) || is_whole(child);
             });
    }
    default:
      return false;
  }
}

/// With the members low .. high: where q <= low the first, elsewhere where q <= low + 1 the second,
/// and so on; over min(max((q - low + 1)(high + 1 - q), 0), 1), which is 1 for each of the whole
/// numbers and 0 beyond them.
std::optional<Bound> Binder::member_of_mode(const Expression& expression, const Node& node) {
  const auto family = scope_.families.find(node.text);
  if (family == scope_.families.end() || environment_.contains(node.text) ||
      family->second.size() != node.children.size())
    return std::nullopt;
  const auto over = std::ranges::find_if(
      node.children, [&](const NodePtr& child) { return is_over_modes(*child); });
  if (over == node.children.end()) return std::nullopt;
  const auto k = static_cast<std::size_t>(over - node.children.begin());
  const auto [low, high] = family->second[k];
  const Emitter make(*this, expression, node);
  const int q = materialise(expression, **over, bind(expression, **over), {});
  const auto number = [&](int value) { return make.number(std::to_string(value)); };
  std::optional<int> chosen;
  for (int i = high; i >= low; --i) {
    auto index = std::make_shared<Node>(**over);
    index->kind = NodeKind::number;
    index->text = std::to_string(i);
    index->children.clear();
    Node one = node;
    one.children[k] = index;
    const int value = sized(expression, one, bind_call(expression, one));
    const int left = make.filled(make.subtract(number(i), q), shape(value));
    chosen = chosen ? make(Op::where, {left, value, *chosen}) : value;
  }
  if (!chosen) fail(expression, node, "the family " + node.text + " has no members");
  const int inside =
      make.multiply(make.subtract(q, number(low - 1)), make.subtract(number(high + 1), q));
  const int either = make(Op::minimum, {make(Op::maximum, {inside, number(0)}), number(1)});
  return Bound{make(Op::divide, {*chosen, either}, {},
                    expression.quote(node) + ": the family has the members " + std::to_string(low) +
                        " to " + std::to_string(high) + ", and '" + expression.quote(**over) +
                        "' is none of them")};
}

std::optional<Bound> Binder::bind_member_call(const Expression& expression, const Node& node) {
  const Node& called = *node.children[0];
  if (std::ranges::any_of(called.children,
                          [&](const NodePtr& child) { return is_over_modes(*child); }))
    return std::nullopt;
  const auto name = member(expression, called);
  if (!name) return std::nullopt;
  const auto function = scope_.functions.find(*name);
  if (function == scope_.functions.end()) return std::nullopt;
  if (node.children.size() != 2)
    fail(expression, node, "'" + *name + "' is a function of one variable");
  return bind_given_function(expression, node, *name, *node.children[1], function->second);
}

bool Binder::holds(const Expression& expression, const Node& comparison) {
  if (comparison.kind != NodeKind::compare)
    fail(expression, comparison,
         "expected a comparison of indices such as i != j, found '" + expression.quote(comparison) +
             "'");
  for (std::size_t k = 0; k < comparison.relations.size(); ++k) {
    const auto side = [&](std::size_t i) {
      return required_whole_number(expression, *comparison.children[i], "a side of the comparison");
    };
    if (!compares(comparison.relations[k], side(k), side(k + 1))) return false;
  }
  return true;
}

/// Of f(i in 1..N, j in 1..N, i != j, M): binds the last argument for all indices that the
/// comparisons leave.
void Binder::for_indices(const Expression& expression, const Node& node,
                         const std::function<void(const Bound&)>& take) {
  const Node& term = *node.children.back();
  const std::function<void(std::size_t)> from = [&](std::size_t k) {
    const Node& child = *node.children[k];
    if (&child == &term) return take(bind(expression, term));
    if (child.kind != NodeKind::each) {
      if (holds(expression, child)) from(k + 1);
      return;
    }
    const auto [low, high] = range_of(expression, *child.children[0], *child.children[1]);
    const auto outer = environment_.find(child.text);
    if (outer != environment_.end() || scope_.symbols.contains(child.text) ||
        scope_.dimensions.contains(child.text))
      fail(expression, child,
           "'" + child.text + "' already has a meaning here; name the index otherwise");
    for (int i = low; i <= high; ++i) {
      environment_[child.text] = {number(expression, child, std::to_string(i))};
      from(k + 1);
      environment_.erase(child.text);
    }
  };
  ++open_sums_;
  from(0);
  --open_sums_;
}

/// Terms are added from left to right, each bound anew with its index.
Bound Binder::sum(const Expression& expression, const Node& node) {
  if (node.children.size() == 1) return sum_of_elements(expression, node);
  if (node.children[0]->kind != NodeKind::each)
    fail(expression, node, "a sum is written sum(i in 1..N, P(i)), or sum(M) of the elements of M");
  std::optional<Bound> total;
  Node pair = node;
  pair.kind = NodeKind::add;
  pair.children = {node.children.back(), node.children.back()};
  for_indices(expression, node, [&](const Bound& value) {
    total = total ? add(expression, pair, Op::add, *total, value) : value;
  });
  return total ? *total : Bound{number(expression, node, "0")};
}

/// The arguments, or the last one for all indices before it.
std::vector<int> Binder::parts(const Expression& expression, const Node& node) {
  std::vector<int> found;
  if (node.children[0]->kind == NodeKind::each && node.children.size() > 1)
    for_indices(expression, node, [&](const Bound& value) {
      found.push_back(sized(expression, *node.children.back(), value));
    });
  else
    for (const NodePtr& child : node.children)
      found.push_back(sized(expression, *child, bind(expression, *child)));
  if (found.empty()) fail(expression, node, node.text + ": the indices have no values");
  return found;
}

/// The parts side by side, or below each other.
Bound Binder::concatenated(const Expression& expression, const Node& node, bool side_by_side) {
  const std::vector<int> blocks = parts(expression, node);
  std::vector<int> lengths;
  const auto across = [&](int block) {
    return side_by_side ? shape(block).rows : shape(block).cols;
  };
  for (const int block : blocks) {
    if (across(block) != across(blocks.front()))
      fail(expression, node,
           node.text + ": all parts need as many " + (side_by_side ? "rows" : "columns") +
               "; one is " + to_string(shape(blocks.front())) + " and another " +
               to_string(shape(block)));
    lengths.push_back(side_by_side ? shape(block).cols : shape(block).rows);
  }
  const std::vector<int> one = {across(blocks.front())};
  if (blocks.size() == 1) return {blocks.front()};
  return {assemble(expression, node, blocks, side_by_side ? static_cast<int>(blocks.size()) : 1,
                   side_by_side ? one : lengths, side_by_side ? lengths : one)};
}

/// 1' M 1.
Bound Binder::sum_of_elements(const Expression& expression, const Node& node) {
  const int at = sized(expression, *node.children[0], bind(expression, *node.children[0]));
  const auto [rows, columns] = shape(at);
  const int one = number(expression, node, "1");
  const int left = emit(expression, node, Op::fill, {one}, {1, rows});
  const int right = emit(expression, node, Op::fill, {one}, {columns, 1});
  if (rows == 1 && columns == 1) return {at};
  const int sums = rows == 1 ? at : emit(expression, node, Op::multiply, {left, at}, {1, columns});
  return {columns == 1 ? sums : emit(expression, node, Op::multiply, {sums, right}, {})};
}

/// [A_11 B, A_12 B; ...]
Bound Binder::kronecker(const Expression& expression, const Node& node) {
  const auto factor = [&](std::size_t i) {
    return sized(expression, *node.children[i], bind(expression, *node.children[i]));
  };
  const int a = factor(0);
  const int b = factor(1);
  const auto [rows, columns] = shape(a);
  if (rows == 1 && columns == 1) return multiply(expression, node, {a}, {b});
  const Shape whole{rows * shape(b).rows, columns * shape(b).cols};
  if (whole.size() == 0) return {emit(expression, node, Op::zeros, {}, whole)};
  std::vector<int> blocks;
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) {
      const int element = emit(expression, node, Op::index, {a}, {}, {i, i + 1, j, j + 1});
      blocks.push_back(multiply(expression, node, {element}, {b}).at);
    }
  return {assemble(expression, node, std::move(blocks), columns,
                   std::vector<int>(static_cast<std::size_t>(rows), shape(b).rows),
                   std::vector<int>(static_cast<std::size_t>(columns), shape(b).cols))};
}

std::pair<int, int> range_of(const Index& index, const Scope& scope) {
  return Binder(scope).range_of(index.low, *index.low.root, *index.high.root);
}

bool whole_condition(const Expression& expression, const Scope& scope) {
  return Binder(scope).holds(expression, *expression.root);
}

}  // namespace gainsmith::expr
