// Disciplined convex programs (Grant, Boyd and Ye 2006), in a small form: a sum of affine terms,
// convex functions on the smaller side and concave ones on the larger side. Each such function f of
// unknowns is replaced by an unknown t with f <= t (f >= t of a concave one). The new problem is
// equivalent, since t may be as small as f.
#include "bind/convex_terms.h"

#include <algorithm>
#include <memory>
#include <span>

#include "base/named.h"
#include "bind/convex.h"
#include "bind/dynamics_names.h"
#include "bind/families.h"
#include "bind/inequalities.h"
#include "bind/quadratic_forms.h"
#include "expr/binding/compile.h"
#include "expr/binding/functions.h"

namespace gainsmith::bind {

namespace {

using expr::Node;
using expr::NodeKind;
using expr::NodePtr;
using expr::Relation;

/// A copy of a node with other children.
NodePtr with_children(const Node& node, std::vector<NodePtr> children) {
  auto changed = std::make_shared<Node>(node);
  changed->children = std::move(children);
  return changed;
}

/// Functions of one matrix, whose value is a number.
bool is_of_matrices(const Node& call) {
  return call.text == "norm" || call.text.starts_with("lambda");
}

/// max(v) and min(v) of one vector.
bool is_of_one_vector(const Node& call) {
  return call.text.starts_with("m") && call.children.size() == 1;
}

/// The shape with the most elements.
expr::Shape largest(const std::vector<expr::Shape>& shapes) {
  return *std::max_element(shapes.begin(), shapes.end(),
                           [](expr::Shape a, expr::Shape b) { return a.size() < b.size(); });
}

/// The tree at another place of the text.
NodePtr placed(const Node& node, const Node& at) {
  auto moved = std::make_shared<Node>(node);
  moved->begin = at.begin;
  moved->end = at.end;
  for (NodePtr& child : moved->children) child = placed(*child, at);
  return moved;
}

/// The sum of terms as a tree that is not deep, at the place of `at`; 0 without terms.
NodePtr sum_of(std::span<const NodePtr> terms, const Node& at) {
  if (terms.size() == 1) return terms.front();
  auto sum = std::make_shared<Node>();
  sum->begin = at.begin;
  sum->end = at.end;
  if (terms.empty()) {
    sum->kind = NodeKind::number;
    sum->text = "0";
    return sum;
  }
  const std::size_t half = terms.size() / 2;
  sum->kind = NodeKind::add;
  sum->children = {sum_of(terms.first(half), at), sum_of(terms.subspan(half), at)};
  return sum;
}

/// A number that is written out and has a digit other than 0 before its exponent.
bool is_positive_number(const Node& node) {
  return node.kind == NodeKind::number &&
         node.text.find_first_of("123456789") < node.text.find_first_of("eE");
}

/// False where no name leads to unknowns.
/// By names alone; quick, and true too often.
bool may_read_unknowns(const Binding& binding, const expr::Expression& part,
                       const expr::Scope& scope) {
  const auto names = names_in(part);
  return std::any_of(names.begin(), names.end(), [&](const std::string& name) {
    return scope.definitions.contains(name) || scope.functions.contains(name) ||
           scope.families.contains(name) ||
           (scope.symbols.contains(name) && !binding.names->known.symbols.contains(name));
  });
}

/// Whether the value depends on unknowns.
bool reads_unknowns(const Binding& binding, const expr::Expression& part,
                    const expr::Scope& scope) {
  if (!may_read_unknowns(binding, part, scope)) return false;
  const expr::Program program = expr::compile(part, scope);
  const auto is_unknown = [&](const expr::Input& input) {
    return !binding.names->known.symbols.contains(input.name) &&
           binding.names->design.symbols.contains(input.name);
  };
  return !program.functions.empty() ||
         std::any_of(program.inputs.begin(), program.inputs.end(), is_unknown);
}

/// Whether the text has such functions, perhaps of data.
/// By names alone, so that most texts need no further work.
bool names_curved(const Binding& binding, const expr::Expression& part, const expr::Scope& scope) {
  const Node& node = *part.root;
  if (curvature_of(node)) return true;
  if (const NodePtr negated = negated_product(part.root))
    return names_curved(binding, {part.text, negated}, scope);
  if (const auto form = quadratic_form(part.root);
      form && may_read_unknowns(binding, {part.text, form->column}, scope))
    return true;
  return std::any_of(node.children.begin(), node.children.end(), [&](const NodePtr& child) {
    return names_curved(binding, {part.text, child}, scope);
  });
}

/// A quadratic form with its shapes.
struct KnownForm {
  QuadraticForm form;
  int elements = 1;
  bool weight_is_number = true;
};

/// The quadratic form of unknowns at a node, if it is one.
/// e'Q e with a column e of unknowns and Q of data. Shapes decide what the text leaves open. A
/// function of numbers such as sin(x) is no affine column.
std::optional<KnownForm> form_at(const Binding& binding, const expr::Expression& text,
                                 const NodePtr& node, const expr::Scope& scope) {
  const auto shape = [&](const NodePtr& part) {
    return expr::compile({text.text, part}, scope).shape();
  };
  auto form = quadratic_form(node);
  if (!form || !reads_unknowns(binding, {text.text, form->column}, scope)) return std::nullopt;
  KnownForm known{*form, 1, true};
  if (form->weight) {
    if (reads_unknowns(binding, {text.text, form->weight}, scope)) return std::nullopt;
    known.weight_is_number = shape(form->weight).is_scalar();
  }
  if (!shape(node).is_scalar()) return std::nullopt;
  const expr::Program program = expr::compile({text.text, form->column}, scope);
  const expr::Instruction& last = program.code.back();
  if (expr::number_function(last.op) != nullptr && last.operands.size() == 1) return std::nullopt;
  const expr::Shape column = program.shape();
  known.elements = column.size();
  if (column.cols == 1) return known;
  std::swap(known.form.column, known.form.row);
  return column.rows == 1 && node->kind != NodeKind::multiply ? std::optional(known) : std::nullopt;
}

/// The function of unknowns at a node, convex or concave, if it is one.
std::optional<Curvature> curvature_at(const Binding& binding, const expr::Expression& text,
                                      const NodePtr& at, const expr::Scope& scope) {
  if (form_at(binding, text, at, scope)) return Curvature::convex;
  const Node& node = *at;
  const auto curvature = curvature_of(node);
  if (!curvature || node.children.empty()) return std::nullopt;
  const bool reads =
      std::any_of(node.children.begin(), node.children.end(), [&](const NodePtr& child) {
        return reads_unknowns(binding, {text.text, child}, scope);
      });
  if (!reads) return std::nullopt;
  const expr::Function& function = *expr::find_function(node.text);
  const int count = static_cast<int>(node.children.size());
  if (count < function.fewest || (function.most >= 0 && count > function.most))
    throw InputError(text.place(node),
                     node.text == "lambda_max" && count == 2
                         ? "lambda_max(M, N) of two matrices is alone in minimize; elsewhere "
                           "write M <= l*N with a number l"
                         : "'" + node.text + "' is written " + std::string(function.usage) +
                               "; found " + std::to_string(count) + " arguments");
  return curvature;
}

/// Whether such a function of unknowns is anywhere in a tree.
bool has_curvature(const Binding& binding, const expr::Expression& text, const NodePtr& node,
                   const expr::Scope& scope) {
  return curvature_at(binding, text, node, scope) ||
         std::any_of(node->children.begin(), node->children.end(), [&](const NodePtr& child) {
           return has_curvature(binding, text, child, scope);
         });
}

/// Whether there are such functions in a call. max and min, which grow with their arguments, take
/// those of their own kind; InputError in others.
bool is_nested(const Binding& binding, const expr::Expression& text, const NodePtr& node,
               const expr::Scope& scope) {
  const Node& call = *node;
  const auto form = form_at(binding, text, node, scope);
  for (const NodePtr& child : form ? std::vector{form->form.column} : call.children) {
    if (!has_curvature(binding, text, child, scope)) continue;
    if (call.text == "max" || call.text == "min") return true;
    throw InputError(text.place(*child),
                     "'" + text.quote(*child) + "' is inside of another such function");
  }
  return false;
}

/// Of the arguments of a call. InputError when the function does not take them.
std::vector<expr::Shape> shapes_of(const expr::Expression& text, const Node& call,
                                   const expr::Scope& scope) {
  std::vector<expr::Shape> shapes;
  for (const NodePtr& child : call.children)
    shapes.push_back(expr::compile({text.text, child}, scope).shape());
  const expr::Shape of = largest(shapes);
  if (call.text.starts_with("lambda") && !of.is_square())
    throw InputError(text.place(call),
                     call.text + " takes a symmetric matrix; found " + to_string(of));
  if (!is_of_matrices(call) && of.rows != 1 && of.cols != 1)
    throw InputError(text.place(call), call.text +
                                           " of unknowns is taken of numbers and vectors; "
                                           "found " +
                                           to_string(of));
  for (std::size_t k = 0; k < shapes.size(); ++k)
    if (!shapes[k].is_scalar() && shapes[k].size() != of.size())
      throw InputError(text.place(*call.children[k]), "'" + text.quote(*call.children[k]) +
                                                          "' is " + to_string(shapes[k]) +
                                                          ", another one " + to_string(of));
  return shapes;
}

/// The comparisons that say that the function at a node is bounded by `bound`. InputError for a
/// bound of another shape.
std::vector<expr::Expression> bounds_of(const Binding& binding, const expr::Expression& text,
                                        const NodePtr& node, const NodePtr& bound,
                                        expr::Scope& scope, bool strict) {
  const Node& call = *node;
  const auto form = form_at(binding, text, node, scope);
  const std::vector<expr::Shape> arguments =
      form ? std::vector<expr::Shape>(1) : shapes_of(text, call, scope);
  const expr::Shape of = largest(arguments);
  const expr::Shape limit = expr::compile({text.text, bound}, scope).shape();
  const bool matrix = form || is_of_matrices(call) || is_of_one_vector(call);
  if (!limit.is_scalar() && (matrix || limit.size() != of.size()))
    throw InputError(text.place(*bound),
                     "'" + text.quote(call) + "' is compared with " +
                         (matrix ? "a number" : "a number or a vector like it") + "; found " +
                         to_string(limit));
  if (form)
    return {{text.text,
             comparison_of(form->form, bound, form->elements, form->weight_is_number, strict)}};
  std::vector<expr::Expression> comparisons;
  for (NodePtr& comparison : comparisons_of(call, bound, arguments, limit.is_scalar(), strict))
    comparisons.push_back({text.text, std::move(comparison)});
  return comparisons;
}

/// Sums over indices with such functions in them as the terms that they have.
NodePtr with_terms(const Binding& binding, const expr::Expression& text, const NodePtr& node,
                   const expr::Scope& scope) {
  constexpr std::size_t kMostTerms = 1000;
  if (!names_curved(binding, {text.text, node}, scope)) return node;
  // -x'*x is (-(x'))*x as it is read, and means -(x'*x).
  if (const NodePtr negated = negated_product(node))
    return with_terms(binding, text, negated, scope);
  const bool indexed = node->kind == NodeKind::call && node->text == "sum" &&
                       node->children.front()->kind == NodeKind::each;
  if (!indexed) {
    std::vector<NodePtr> children;
    for (const NodePtr& child : node->children)
      children.push_back(with_terms(binding, text, child, scope));
    return with_children(*node, std::move(children));
  }
  std::vector<expr::Index> indices;
  std::vector<expr::Expression> conditions;
  for (std::size_t k = 0; k + 1 < node->children.size(); ++k) {
    const Node& child = *node->children[k];
    if (child.kind == NodeKind::each)
      indices.push_back({child.text,
                         {text.text, child.children[0]},
                         {text.text, child.children[1]},
                         text.place(child)});
    else
      conditions.push_back({text.text, node->children[k]});
  }
  std::vector<NodePtr> terms;
  for (const Member& member : members(indices, conditions, scope)) {
    if (terms.size() == kMostTerms)
      throw InputError(text.place(*node), "a sum of norms, moduli or eigenvalues has at most " +
                                              std::to_string(kMostTerms) + " terms");
    const expr::Expression expression =
        expr::instantiate({text.text, node->children.back()}, member.indices, scope.families);
    terms.push_back(placed(*with_terms(binding, expression, expression.root, scope), *node));
  }
  return sum_of(terms, *node);
}

/// An unknown that bounds the function at `call`, as a node that represents it.
/// Its name is that of the function with a number, "norm_1"; the design gets it with its
/// inequality.
NodePtr bounding_unknown(Binding& binding, const expr::Expression& text, const NodePtr& node,
                         Curvature curvature) {
  expr::Scope& scope = binding.names->design;
  const Node& call = *node;
  const auto form = form_at(binding, text, node, scope);
  constexpr std::size_t kMost = 10'000;
  if (binding.design->unknowns.size() >= kMost)
    throw InputError(text.place(call),
                     "there are more than " + std::to_string(kMost) + " unknowns");
  model::Design::Unknown unknown;
  if (!form && !is_of_matrices(call) && !is_of_one_vector(call))
    unknown.shape = largest(shapes_of(text, call, scope));
  unknown.structure = unknown.shape.is_scalar() ? model::Structure::scalar : model::Structure::full;
  unknown.place = text.place(call);
  const auto is_taken = [&](const std::string& name) {
    return scope.symbols.contains(name) || scope.definitions.contains(name) ||
           scope.dimensions.contains(name) || name == timer_name(binding.method()) ||
           has_named(binding.method().gains, name) ||
           std::any_of(binding.method().observers.begin(), binding.method().observers.end(),
                       [&](const model::Component& component) {
                         return names_of(component).contains(name);
                       }) ||
           names_of(binding.method().plant).contains(name);
  };
  for (int k = 1; unknown.name.empty() || is_taken(unknown.name); ++k)
    unknown.name = (form ? "square" : call.text) + "_" + std::to_string(k);
  scope.symbols[unknown.name] = {unknown.shape};
  auto name = std::make_shared<Node>(call);
  name->kind = NodeKind::name;
  name->text = unknown.name;
  name->children.clear();
  model::Design::Inequality bound;
  const std::string quoted = text.quote(call);
  // A term of a sum over an index has the place of the sum.
  const bool own = form || quoted.starts_with(call.text);
  bound.name = unknown.name + (curvature == Curvature::convex ? " >= " : " <= ") +
               (own ? quoted : call.text + " in " + quoted);
  bound.place = bound.that_place = unknown.place;
  binding.design->unknowns.push_back(std::move(unknown));
  add_comparisons(bounds_of(binding, text, node, name, scope, false), bound, bound.name, "", scope);
  binding.design->inequalities.push_back(std::move(bound));
  return name;
}

/// Notes the weight of a quadratic form, which has to be shown to be positive semidefinite.
void ask_convexity(Binding& binding, const expr::Expression& text, const NodePtr& node,
                   const expr::Scope& scope) {
  const auto form = form_at(binding, text, node, scope);
  if (!form || !form->form.weight) return;
  const expr::Expression weight{text.text, form->form.weight};
  const Place place = text.place(*weight.root);
  for (const std::string& name : names_in(weight))
    if (scope.symbols.contains(name) && !binding.names->known.symbols.contains(name))
      throw InputError(place, "the weight of a square under 'forall' may not depend on '" + name +
                                  "': take it into the column, as in norm(R*e)^2");
  binding.design->squares.push_back(
      {expr::compile(weight, binding.names->known), text.quote(*node), place});
}

/// The text with bounding unknowns for convex functions where it may be large (sign 1), for concave
/// ones where it may be small (sign -1).
/// The rules of sign: a sum keeps it, a difference and a minus turn it on their operands, and a
/// number that is written out and positive keeps it. InputError for any other place of such a
/// function.
NodePtr bounded(Binding& binding, const expr::Expression& text, const NodePtr& node, int sign,
                bool quantified, const expr::Scope& scope) {
  if (!has_curvature(binding, text, node, scope)) return node;
  const auto inner = [&](const NodePtr& child, int s) {
    return bounded(binding, text, child, s, quantified, scope);
  };
  if (const auto curvature = curvature_at(binding, text, node, scope)) {
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
                                              "' must be alone on its side of the comparison");
    ask_convexity(binding, text, node, scope);
    NodePtr call = node;
    if (is_nested(binding, text, node, scope)) {
      std::vector<NodePtr> arguments;
      for (const NodePtr& child : node->children) arguments.push_back(inner(child, sign));
      call = with_children(*node, std::move(arguments));
    }
    return bounding_unknown(binding, text, call, *curvature);
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
  throw InputError(
      text.place(*node),
      "norm, abs, max, min, squares and eigenvalues of unknowns may be used in sums, in sum(...) "
      "and times a number that is written out, not inside of '" +
          text.quote(*node) + "'; a weight w >= 0 goes inside, as in norm(w*X)");
}

}  // namespace

/// A function that is alone on its side is bounded by the other side itself, without an unknown.
std::vector<expr::Expression> affine_comparisons(Binding& binding, const expr::Expression& stated,
                                                 expr::Scope& scope, bool quantified) {
  const expr::Expression that{stated.text, with_terms(binding, stated, stated.root, scope)};
  const Node& chain = *that.root;
  if (chain.kind != NodeKind::compare || !has_curvature(binding, that, that.root, scope))
    return {that};
  std::vector<expr::Expression> comparisons;
  for (std::size_t k = 0; k < chain.relations.size(); ++k) {
    const Relation relation = chain.relations[k];
    if (relation == Relation::equal || relation == Relation::not_equal)
      throw InputError(that.place(chain), "'" + to_string(relation) + "' takes affine sides");
    const bool ascending = relation == Relation::less || relation == Relation::less_equal;
    const bool strict = relation == Relation::less || relation == Relation::greater;
    const NodePtr& small = chain.children[ascending ? k : k + 1];
    const NodePtr& large = chain.children[ascending ? k + 1 : k];
    const auto alone = [&](const NodePtr& side, const NodePtr& other, Curvature wanted) {
      if (curvature_at(binding, that, side, scope) != wanted ||
          has_curvature(binding, that, other, scope) || is_nested(binding, that, side, scope))
        return false;
      // Such a requirement may be relaxed, which its block [g, e'*Q; Q*e, Q] >= 0 should not be;
      // and > would ask for Q > 0.
      if (!quantified && form_at(binding, that, side, scope)) return false;
      ask_convexity(binding, that, side, scope);
      for (expr::Expression& bound : bounds_of(binding, that, side, other, scope, strict))
        comparisons.push_back(std::move(bound));
      return true;
    };
    if (alone(small, large, Curvature::convex) || alone(large, small, Curvature::concave)) continue;
    auto pair = std::make_shared<Node>(chain);
    pair->children = {bounded(binding, that, small, 1, quantified, scope),
                      bounded(binding, that, large, -1, quantified, scope)};
    pair->relations = {strict ? Relation::less : Relation::less_equal};
    comparisons.push_back({that.text, pair});
    scope.symbols.insert(binding.names->design.symbols.begin(),
                         binding.names->design.symbols.end());
  }
  return comparisons;
}

/// Sums over indices are written out before.
expr::Expression affine_objective(Binding& binding, const expr::Expression& text) {
  const expr::Scope& scope = binding.names->design;
  return {text.text,
          bounded(binding, text, with_terms(binding, text, text.root, scope), 1, false, scope)};
}

}  // namespace gainsmith::bind
