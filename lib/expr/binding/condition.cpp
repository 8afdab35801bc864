#include "expr/binding/condition.h"

#include <utility>

#include "expr/binding/binder.h"
#include "expr/text/work.h"

namespace gainsmith::expr {

namespace {

using Kind = Condition::Kind;

/// `<` and `<=` become `>` and `>=` with the sides exchanged (ordered_pair).
Kind kind_of(Relation relation) {
  if (relation == Relation::equal || relation == Relation::not_equal) return Kind::zero;
  return relation == Relation::less || relation == Relation::greater ? Kind::positive
                                                                     : Kind::nonnegative;
}

Condition with_parts(Kind kind, std::vector<Condition> parts, const Expression& expression,
                     const Node& node) {
  Condition condition;
  condition.kind = kind;
  condition.parts = std::move(parts);
  condition.text = expression.quote(node);
  condition.place = expression.place(node);
  return condition;
}

/// Comparison `at` of a chain. a != b is the negation of a == b.
Condition comparison(const Expression& expression, const Node& chain, std::size_t at,
                     const Scope& scope) {
  const Relation relation = chain.relations[at];
  const Node pair = ordered_pair(chain, at);
  Condition condition = with_parts(kind_of(relation), {}, expression, pair);
  Binder binder(scope);
  condition.difference = binder.extract(binder.difference(expression, pair));
  if (relation != Relation::not_equal) return condition;
  return with_parts(Kind::none, {std::move(condition)}, expression, pair);
}

/// A tree of comparisons and of `and`, `or`, `not` as a tree of conditions.
Condition bind(const Expression& expression, const Node& node, const Scope& scope) {
  std::vector<Condition> parts;
  switch (node.kind) {
    case NodeKind::compare:
      for (std::size_t i = 0; i < node.relations.size(); ++i)
        parts.push_back(comparison(expression, node, i, scope));
      if (parts.size() == 1) return std::move(parts.front());
      return with_parts(Kind::all, std::move(parts), expression, node);
    case NodeKind::conjunction:
    case NodeKind::disjunction:
    case NodeKind::negation:
      for (const NodePtr& child : node.children) parts.push_back(bind(expression, *child, scope));
      return with_parts(node.kind == NodeKind::conjunction   ? Kind::all
                        : node.kind == NodeKind::disjunction ? Kind::any
                                                             : Kind::none,
                        std::move(parts), expression, node);
    default:
      throw InputError(expression.place(node), "expected a condition such as x(1) <= 0, found '" +
                                                   expression.quote(node) + "'");
  }
}

}  // namespace

bool is_condition(const Expression& expression) {
  const NodeKind kind = expression.root->kind;
  return kind == NodeKind::compare || kind == NodeKind::conjunction ||
         kind == NodeKind::disjunction || kind == NodeKind::negation;
}

Condition compile_condition(const Expression& expression, const Scope& scope) {
  count_bound();
  return bind(expression, *expression.root, scope);
}

}  // namespace gainsmith::expr
