#include "bind/quadratic_forms.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "bind/trees.h"

namespace gainsmith::bind {

using expr::Node;
using expr::NodeKind;
using expr::NodePtr;

namespace {

/// Whether two trees are written alike.
bool is_same(const Node& a, const Node& b) {
  return a.kind == b.kind && a.text == b.text && a.columns == b.columns &&
         a.relations == b.relations &&
         std::equal(a.children.begin(), a.children.end(), b.children.begin(), b.children.end(),
                    [](const NodePtr& x, const NodePtr& y) { return is_same(*x, *y); });
}

/// Whether a is written as b'.
bool is_transpose(const Node& a, const Node& b) {
  return a.kind == NodeKind::transpose && is_same(*a.children.front(), b);
}

/// `all`: also those of factors in parentheses.
std::vector<NodePtr> factors_of(const NodePtr& product, bool all) {
  if (product->kind != NodeKind::multiply) return {product};
  std::vector<NodePtr> factors = factors_of(product->children[0], all);
  const NodePtr& last = product->children[1];
  for (NodePtr& factor : all ? factors_of(last, true) : std::vector{last})
    factors.push_back(std::move(factor));
  return factors;
}

/// The last factor e, a factor e' (or e itself) before it, and the product of all others as the
/// weight.
std::optional<QuadraticForm> form_of(const std::vector<NodePtr>& factors, const Trees& trees) {
  const NodePtr& last = factors.back();
  const auto mirrored =
      std::find_if(factors.begin(), factors.end() - 1, [&](const NodePtr& factor) {
        return is_transpose(*factor, *last) || is_transpose(*last, *factor) ||
               is_same(*factor, *last);
      });
  if (mirrored == factors.end() - 1) return std::nullopt;
  NodePtr weight;
  for (auto factor = factors.begin(); factor != factors.end() - 1; ++factor)
    if (factor != mirrored) weight = weight ? trees.times(weight, *factor) : *factor;
  return QuadraticForm{last, *mirrored, weight};
}

}  // namespace

/// Factors are tried as written first, then with those in parentheses.
std::optional<QuadraticForm> quadratic_form(const NodePtr& node) {
  const Trees trees(*node);
  const auto turned = [&](const NodePtr& child) {
    return trees.make(NodeKind::transpose, {child});
  };
  const bool of_elements = node->kind == NodeKind::call && node->text == "sum" &&
                           node->children.size() == 1 &&
                           node->children[0]->kind == NodeKind::elementwise_power;
  if (of_elements) return quadratic_form(trees.make(NodeKind::power, node->children[0]->children));
  if (node->kind == NodeKind::power) {
    const NodePtr& base = node->children[0];
    if (node->children[1]->kind != NodeKind::number || node->children[1]->text != "2")
      return std::nullopt;
    const bool of_norm =
        base->kind == NodeKind::call && base->text == "norm" && base->children.size() == 1;
    const NodePtr& column = of_norm ? base->children.front() : base;
    return QuadraticForm{column, turned(column), nullptr};
  }
  if (node->kind != NodeKind::multiply) return std::nullopt;
  auto form = form_of(factors_of(node, false), trees);
  return form ? form : form_of(factors_of(node, true), trees);
}

/// The weight counts by its symmetric part, (Q + Q')/2.
NodePtr comparison_of(const QuadraticForm& form, const NodePtr& bound, int n, bool weight_is_number,
                      bool strict) {
  const Trees trees(*bound);
  const NodePtr identity = trees.call("eye", trees.number(n));
  const NodePtr weight =
      !form.weight ? identity
      : weight_is_number
          ? trees.times(form.weight, identity)
          : trees.make(NodeKind::divide, {trees.call("He", form.weight), trees.number(2)});
  return trees.at_most(trees.number(0),
                       trees.block({bound, form.weight ? trees.times(form.row, weight) : form.row,
                                    trees.make(NodeKind::mirror, {}), weight}),
                       strict);
}

/// As it is read, -a*b is (-a)*b. The form is found in a*b.
NodePtr negated_product(const NodePtr& node) {
  if (node->kind != NodeKind::multiply) return nullptr;
  const Trees trees(*node);
  const NodePtr& first = node->children[0];
  if (first->kind == NodeKind::negate)
    return trees.make(NodeKind::negate, {trees.times(first->children[0], node->children[1])});
  const NodePtr inner = negated_product(first);
  if (!inner) return nullptr;
  return trees.make(NodeKind::negate, {trees.times(inner->children[0], node->children[1])});
}

}  // namespace gainsmith::bind
