// Requirements and objectives with convex functions of unknowns (convex.h).
#include <algorithm>
#include <memory>

#include "model/binding.h"
#include "model/convex.h"

namespace gainsmith::model {

namespace {

using expr::Node;
using expr::NodeKind;
using expr::NodePtr;
using expr::Relation;

NodePtr with_children(const Node& node, std::vector<NodePtr> children) {
  auto changed = std::make_shared<Node>(node);
  changed->children = std::move(children);
  return changed;
}

bool is_positive_number(const Node& node) {
  return node.kind == NodeKind::number && node.text.find_first_of("123456789") != std::string::npos;
}

}  // namespace

/// Whether the value depends on unknowns.
bool Binding::reads_unknowns(const expr::Expression& part, const expr::Scope& scope) const {
  const auto names = names_in(part);
  const bool may = std::any_of(names.begin(), names.end(), [&](const std::string& name) {
    return scope.definitions.contains(name) || scope.functions.contains(name) ||
           scope.families.contains(name) || !names_->known.symbols.contains(name);
  });
  if (!may || part.root->kind == NodeKind::number) return false;
  const expr::Program program = expr::compile(part, scope);
  const auto is_unknown = [&](const expr::Input& input) {
    return !names_->known.symbols.contains(input.name) &&
           names_->design.symbols.contains(input.name);
  };
  return !program.functions.empty() ||
         std::any_of(program.inputs.begin(), program.inputs.end(), is_unknown);
}

/// The function of unknowns at a node, convex or concave, if it is one.
std::optional<Curvature> Binding::curvature_at(const expr::Expression& text, const Node& node,
                                               const expr::Scope& scope) const {
  const auto curvature = curvature_of(node);
  if (!curvature) return std::nullopt;
  const bool reads =
      std::any_of(node.children.begin(), node.children.end(), [&](const NodePtr& child) {
        return reads_unknowns({text.text, child}, scope);
      });
  return reads ? curvature : std::nullopt;
}

bool Binding::has_curvature(const expr::Expression& text, const Node& node,
                            const expr::Scope& scope) const {
  return curvature_at(text, node, scope) ||
         std::any_of(node.children.begin(), node.children.end(),
                     [&](const NodePtr& child) { return has_curvature(text, *child, scope); });
}

void Binding::refuse_nested(const expr::Expression& text, const Node& call,
                            const expr::Scope& scope) const {
  for (const NodePtr& child : call.children)
    if (has_curvature(text, *child, scope))
      throw InputError(text.place(*child),
                       "'" + text.quote(*child) + "' stands inside of another such function");
}

std::vector<expr::Expression> Binding::bounds_of(const expr::Expression& text, const Node& call,
                                                 const NodePtr& bound, expr::Scope& scope,
                                                 bool strict) const {
  const expr::Shape of = expr::compile({text.text, call.children.front()}, scope).shape();
  const expr::Shape limit = expr::compile({text.text, bound}, scope).shape();
  const bool matrix = call.text == "norm" || call.text.starts_with("lambda");
  const bool vector = of.rows == 1 || of.cols == 1;
  if (call.text.starts_with("lambda") && !of.is_square())
    throw InputError(text.place(call),
                     call.text + " takes a symmetric matrix; found " + to_string(of));
  if (!matrix && !vector)
    throw InputError(text.place(call), call.text +
                                           " of unknowns is taken of numbers and vectors; "
                                           "found " +
                                           to_string(of));
  if (!limit.is_scalar() && (matrix || limit.size() != of.size()))
    throw InputError(text.place(*bound),
                     "'" + text.quote(call) + "' is compared with " +
                         (matrix ? "a number" : "a number or a vector like it") + "; found " +
                         to_string(limit));
  std::vector<expr::Expression> comparisons;
  for (NodePtr& comparison :
       comparisons_of(call, bound, of.rows, of.cols, limit.is_scalar(), strict))
    comparisons.push_back({text.text, std::move(comparison)});
  return comparisons;
}

/// An unknown that bounds the function at `call`, as a node that stands for it.
NodePtr Binding::bounding_unknown(const expr::Expression& text, const Node& call,
                                  Curvature curvature) {
  expr::Scope& scope = names_->design;
  const bool matrix = call.text == "norm" || call.text.starts_with("lambda");
  const expr::Shape of = expr::compile({text.text, call.children.front()}, scope).shape();
  Design::Unknown unknown;
  unknown.shape = matrix ? expr::Shape{} : of;
  unknown.structure = unknown.shape.is_scalar() ? Structure::scalar : Structure::full;
  unknown.place = text.place(call);
  for (int k = 1; unknown.name.empty() || scope.symbols.contains(unknown.name); ++k)
    unknown.name = call.text + "_" + std::to_string(k);
  scope.symbols[unknown.name] = {unknown.shape};
  auto name = std::make_shared<Node>(call);
  name->kind = NodeKind::name;
  name->text = unknown.name;
  name->children.clear();
  Design::Inequality bound;
  bound.name = unknown.name + (curvature == Curvature::convex ? " >= " : " <= ") + text.quote(call);
  bound.place = bound.that_place = unknown.place;
  design_->unknowns.push_back(std::move(unknown));
  add_comparisons(bounds_of(text, call, name, scope, false), bound, bound.name, "", scope);
  design_->inequalities.push_back(std::move(bound));
  return name;
}

/// The text with bounding unknowns for convex functions where it may be large (sign 1), for concave
/// ones where it may be small (sign -1).
NodePtr Binding::bounded(const expr::Expression& text, const NodePtr& node, int sign,
                         bool quantified, const expr::Scope& scope) {
  if (!has_curvature(text, *node, scope)) return node;
  const auto inner = [&](const NodePtr& child, int s) {
    return bounded(text, child, s, quantified, scope);
  };
  if (const auto curvature = curvature_at(text, *node, scope)) {
    if ((*curvature == Curvature::convex) != (sign > 0))
      throw InputError(text.place(*node),
                       "'" + text.quote(*node) + "' is " +
                           (*curvature == Curvature::convex
                                ? "convex: it can only be asked to be small, on the smaller side "
                                  "of a comparison or in minimize"
                                : "concave: it can only be asked to be large, on the larger side "
                                  "of a comparison"));
    if (quantified)
      throw InputError(text.place(*node), "under 'forall' with an interval or a set, '" +
                                              text.quote(*node) +
                                              "' stands alone on its side of the comparison");
    refuse_nested(text, *node, scope);
    return bounding_unknown(text, *node, *curvature);
  }
  const auto& children = node->children;
  switch (node->kind) {
    case NodeKind::add:
      return with_children(*node, {inner(children[0], sign), inner(children[1], sign)});
    case NodeKind::subtract:
      return with_children(*node, {inner(children[0], sign), inner(children[1], -sign)});
    case NodeKind::negate:
      return with_children(*node, {inner(children[0], -sign)});
    case NodeKind::multiply:
      for (const std::size_t k : {0U, 1U})
        if (is_positive_number(*children[k])) {
          auto changed = children;
          changed[1 - k] = inner(children[1 - k], sign);
          return with_children(*node, std::move(changed));
        }
      break;
    case NodeKind::divide:
      if (is_positive_number(*children[1]))
        return with_children(*node, {inner(children[0], sign), children[1]});
      break;
    case NodeKind::call:
      if (node->text == "sum" && children.size() == 1)
        return with_children(*node, {inner(children[0], sign)});
      break;
    default:
      break;
  }
  throw InputError(text.place(*node),
                   "norm, abs, max, min and eigenvalues of unknowns may stand in sums, in sum(...) "
                   "and times a number that is written out, not inside of '" +
                       text.quote(*node) + "'");
}

/// A comparison chain without convex functions of unknowns: the chain itself where there are none.
std::vector<expr::Expression> Binding::affine_comparisons(const expr::Expression& that,
                                                          expr::Scope& scope, bool quantified) {
  const Node& chain = *that.root;
  if (chain.kind != NodeKind::compare || !has_curvature(that, chain, scope)) return {that};
  std::vector<expr::Expression> comparisons;
  for (std::size_t k = 0; k < chain.relations.size(); ++k) {
    const Relation relation = chain.relations[k];
    if (relation == Relation::equal || relation == Relation::not_equal)
      throw InputError(that.place(chain), "'==' takes affine sides");
    const bool ascending = relation == Relation::less || relation == Relation::less_equal;
    const bool strict = relation == Relation::less || relation == Relation::greater;
    const NodePtr& small = chain.children[ascending ? k : k + 1];
    const NodePtr& large = chain.children[ascending ? k + 1 : k];
    const auto alone = [&](const NodePtr& side, const NodePtr& other, Curvature wanted) {
      if (curvature_at(that, *side, scope) != wanted || has_curvature(that, *other, scope))
        return false;
      refuse_nested(that, *side, scope);
      for (expr::Expression& bound : bounds_of(that, *side, other, scope, strict))
        comparisons.push_back(std::move(bound));
      return true;
    };
    if (alone(small, large, Curvature::convex) || alone(large, small, Curvature::concave)) continue;
    auto pair = std::make_shared<Node>(chain);
    pair->children = {bounded(that, small, 1, quantified, scope),
                      bounded(that, large, -1, quantified, scope)};
    pair->relations = {strict ? Relation::less : Relation::less_equal};
    comparisons.push_back({that.text, pair});
    scope.symbols.insert(names_->design.symbols.begin(), names_->design.symbols.end());
  }
  return comparisons;
}

}  // namespace gainsmith::model
