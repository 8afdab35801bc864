// where(condition, x, y) and the differences of conditions.
//
// where(condition, x, y) and the differences of conditions. Conditions with `and`, `or`, `not`
// become nested choices by one difference each:
//
//   where(a and b, x, y) = where(a, where(b, x, y), y)      where(not a, x, y) = where(a, y, x)
//   where(a or b, x, y)  = where(a, x, where(b, x, y))
//
// Equality d = 0 is d >= 0 and -d >= 0.
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "expr/binding/binder.h"

namespace gainsmith::expr {

Bound Binder::where(const Expression& expression, const Node& node) {
  const Bound yes = bind(expression, *node.children[1]);
  const Bound no = bind(expression, *node.children[2]);
  const Node& condition = *node.children[0];
  switch (condition.kind) {
    case NodeKind::compare:
    case NodeKind::conjunction:
    case NodeKind::disjunction:
    case NodeKind::negation:
      return chosen(expression, node, condition, yes, no);
    default:
      fail(expression, condition, "where needs a condition first, such as where(x > 0, a, b)");
  }
}

/// `yes` where the condition holds, `no` elsewhere.
Bound Binder::chosen(const Expression& expression, const Node& node, const Node& condition,
                     Bound yes, Bound no) {
  const auto& parts = condition.children;
  Bound value = yes;
  switch (condition.kind) {
    case NodeKind::negation:
      return chosen(expression, node, *parts[0], no, yes);
    case NodeKind::conjunction:
      for (std::size_t k = parts.size(); k-- > 0;)
        value = chosen(expression, node, *parts[k], value, no);
      return value;
    case NodeKind::disjunction:
      value = no;
      for (std::size_t k = parts.size(); k-- > 0;)
        value = chosen(expression, node, *parts[k], yes, value);
      return value;
    case NodeKind::compare:
      for (std::size_t k = condition.relations.size(); k-- > 0;)
        value = compared(expression, node, condition, k, value, no);
      return value;
    default:
      fail(expression, condition, "expected a condition, such as x > 0");
  }
}

/// The same of comparison k of a chain.
Bound Binder::compared(const Expression& expression, const Node& node, const Node& chain,
                       std::size_t k, Bound yes, Bound no) {
  const Relation relation = chain.relations[k];
  const Node pair = ordered_pair(chain, k);
  const int above = difference(expression, pair);
  if (relation == Relation::not_equal) std::swap(yes, no);
  if (relation != Relation::equal && relation != Relation::not_equal) {
    const bool strict = relation == Relation::less || relation == Relation::greater;
    return branch(expression, node, above, strict, yes, no);
  }
  const int below = emit(expression, pair, Op::negate, {above}, shape(above));
  return branch(expression, node, above, false, branch(expression, node, below, false, yes, no),
                no);
}

/// The value of numbers that are written out, such as an index; none of others, and of those so
/// near 0 that rounding may decide their sign.
std::optional<double> Binder::written_number(int at) const {
  constexpr double kClear = 1e-6;
  if (!shape(at).is_scalar() || !scope_.known) return std::nullopt;
  const Program program = assembly_.extract(at);
  if (!program.inputs.empty() || !program.functions.empty()) return std::nullopt;
  const bool is_whole = std::ranges::all_of(program.code, [](const Instruction& instruction) {
    return instruction.op == Op::constant
               ? instruction.text.find_first_not_of("0123456789") == std::string::npos
               : is_one_of(instruction.op, {Op::add, Op::subtract, Op::negate, Op::multiply});
  });
  const double value = scope_.known->number(program);
  return is_whole || std::abs(value) >= kClear ? std::optional(value) : std::nullopt;
}

/// A number beside a column counts for each element. A written difference decides at once, so that
/// the side which is left out needs no value.
Bound Binder::branch(const Expression& expression, const Node& node, int difference, bool strict,
                     Bound yes, Bound no) {
  Shape common;
  for (const Bound& value : {Bound{difference}, yes, no}) {
    const int at = sized(expression, node, value);
    if (!shape(at).is_scalar()) common = shape(at);
  }
  if (const auto sign = written_number(difference)) {
    const bool holds = strict ? *sign > 0 : *sign >= 0;
    return {same_shape(expression, *node.children[holds ? 1 : 2], holds ? yes : no, common)};
  }
  return {emit(expression, node, Op::where,
               {same_shape(expression, *node.children[0], {difference}, common),
                same_shape(expression, *node.children[1], yes, common),
                same_shape(expression, *node.children[2], no, common)},
               common, {strict ? 1 : 0})};
}

Node ordered_pair(const Node& chain, std::size_t k) {
  const Relation relation = chain.relations[k];
  const bool ascending = relation == Relation::less || relation == Relation::less_equal;
  Node pair;
  pair.kind = NodeKind::compare;
  pair.begin = chain.children[k]->begin;
  pair.end = chain.children[k + 1]->end;
  pair.children = {chain.children[ascending ? k + 1 : k], chain.children[ascending ? k : k + 1]};
  return pair;
}

int Binder::difference(const Expression& expression, const Node& pair) {
  const Bound larger = bind(expression, *pair.children[0]);
  const Bound smaller = bind(expression, *pair.children[1]);
  return sized(expression, pair, subtract(expression, pair, larger, smaller));
}

}  // namespace gainsmith::expr
