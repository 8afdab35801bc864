// Gains such as inv(P)*Y of unknowns P and Y. Each product with an inverse of an unknown, inv(S)*R
// or R*inv(S), is kept with its factors as texts and programs, for the bounds of gains.h.
#include "bind/gains.h"

#include <algorithm>
#include <map>
#include <memory>

#include "base/named.h"
#include "base/nearest.h"
#include "bind/estimates.h"
#include "bind/families.h"
#include "bind/formulas.h"
#include "expr/text/parser.h"

namespace gainsmith::bind {

namespace {

using expr::Node;
using expr::NodeKind;
using expr::NodePtr;

/// The factors of a product, from left to right.
void factors_of(const NodePtr& node, std::vector<NodePtr>& factors) {
  if (node->kind != NodeKind::multiply) {
    factors.push_back(node);
    return;
  }
  factors_of(node->children[0], factors);
  factors_of(node->children[1], factors);
}

/// The product of factors as one expression.
NodePtr product_of(const std::vector<NodePtr>& factors) {
  NodePtr product = factors.front();
  for (std::size_t k = 1; k < factors.size(); ++k) {
    auto node = std::make_shared<Node>();
    node->kind = NodeKind::multiply;
    node->begin = factors.front()->begin;
    node->end = factors[k]->end;
    node->children = {product, factors[k]};
    product = node;
  }
  return product;
}

/// Finds the products of one formula.
/// Only texts are searched: inv(...) of a name, or of a call of an unknown function, beside other
/// factors.
class Products {
 public:
  Products(const model::Design& design, const model::Gain& gain, const expr::Scope& scope)
      : design_(design), gain_(gain), scope_(scope) {}

  /// Within a product, inv(S) is taken with all factors to its right, or with those to its left
  /// where it is the last.
  void find(const NodePtr& node, std::vector<model::Design::Product>& found) const {
    std::vector<NodePtr> factors;
    factors_of(node, factors);
    for (std::size_t k = 0; k < factors.size(); ++k) {
      const NodePtr argument = inverted_by(*factors[k]);
      const std::string inverse = argument ? written(*argument) : "";
      const auto at = factors.begin() + static_cast<std::ptrdiff_t>(k);
      if (!inverse.empty() && k + 1 < factors.size())
        found.push_back(product(argument, {at + 1, factors.end()}, true));
      if (!inverse.empty() && k + 1 == factors.size() && k > 0)
        found.push_back(product(argument, {factors.begin(), at}, false));
      if (inverse.empty())
        for (const NodePtr& child : factors[k]->children) find(child, found);
    }
  }

  /// The factors as they are written, and as one program.
  model::Design::Product::Factor factor(const std::vector<NodePtr>& factors) const {
    model::Design::Product::Factor result;
    for (const NodePtr& part : factors) {
      const bool sum = part->kind == NodeKind::add || part->kind == NodeKind::subtract;
      result.text += result.text.empty() ? "" : "*";
      result.text += sum ? "(" : "";
      add_calls(*part, result.text.size() - part->begin, result.calls);
      result.text += written(*part);
      result.text += sum ? ")" : "";
    }
    std::sort(result.calls.begin(), result.calls.end());
    try {
      result.program = expr::compile({gain_.value.text, product_of(factors)}, scope_);
    } catch (const InputError&) {
      // A multiple of I without a size: there is no matrix to bound.
    }
    return result;
  }

 private:
  /// S of inv(S) with a square unknown S, or S(t) of a function.
  NodePtr inverted_by(const Node& node) const {
    if (node.kind != NodeKind::call || node.text != "inv" || node.children.size() != 1)
      return nullptr;
    const Node& argument = *node.children.front();
    for (const model::Design::Unknown& unknown : design_.unknowns) {
      const NodeKind kind = unknown.variable.empty() ? NodeKind::name : NodeKind::call;
      if (unknown.name == argument.text && argument.kind == kind && unknown.shape.is_square())
        return node.children.front();
    }
    return nullptr;
  }

  /// `left`: the inverse is on the left side.
  model::Design::Product product(const NodePtr& inverted, const std::vector<NodePtr>& factors,
                                 bool left) const {
    return {written(*inverted), factor({inverted}), left, factor(factors),
            factor({left ? factors.front() : factors.back()})};
  }

  /// The source of a node.
  std::string written(const Node& node) const {
    return gain_.value.text->str().substr(node.begin, node.end - node.begin);
  }

  /// Where calls of unknown functions are in the text, byte and length, since their arguments may
  /// change.
  void add_calls(const Node& node, std::size_t shift,
                 std::vector<std::pair<std::size_t, std::size_t>>& calls) const {
    if (node.kind == NodeKind::call && scope_.functions.contains(node.text))
      calls.emplace_back(node.begin + shift, node.end - node.begin);
    for (const NodePtr& child : node.children) add_calls(*child, shift, calls);
  }

  const model::Design& design_;
  const model::Gain& gain_;
  const expr::Scope& scope_;
};

/// The scope of a gain's formula.
expr::Scope gain_scope(expr::Scope scope, const std::string& variable) {
  if (!variable.empty()) scope.symbols[variable] = {};
  return scope;
}

/// One gain: its formula, its shape and its products.
void add_gain(Binding& binding, const model::Gain& gain, const expr::Scope& names) {
  const expr::Scope scope = gain_scope(names, gain.variable);
  model::Design::Gain bound;
  bound.name = gain.name;
  bound.variable = gain.variable;
  bound.formula = formula(gain.value, scope);
  bound.shape = bound.formula.program.shape();
  note_estimate(*binding.design, gain.name, bound.formula.program);
  const Products products(*binding.design, gain, scope);
  products.find(gain.value.root, bound.products);
  bound.whole = products.factor({gain.value.root});
  binding.design->gains.push_back(std::move(bound));
}

/// The bound of a family is that of each of its members.
void bind_gain_bounds(Binding& binding) {
  std::vector<model::BoundOfGain> bounds;
  const std::vector<std::string> names = names_of_all(binding.method().gains);
  for (const model::BoundOfGain& stated : binding.source->synthesis.gain_bounds) {
    const std::size_t before = bounds.size();
    for (const model::Gain& gain : binding.method().gains)
      for (const Member& member : members(gain.indices, {}, binding.names->design))
        if (const std::string name = member.name_of(gain.name);
            stated.gain == gain.name || stated.gain == name)
          bounds.push_back({name, stated.bound, stated.place});
    if (bounds.size() == before)
      throw InputError(stated.place, "the method " + binding.method().name + " has no gain '" +
                                         stated.gain + "'" + suggestion(stated.gain, names));
  }
  binding.design->synthesis.gain_bounds = std::move(bounds);
}

}  // namespace

/// A gain that other gains use is a definition to them, so that its products are found there too.
void bind_gains(Binding& binding) {
  std::map<std::string, expr::Ranges> families;
  std::vector<model::Gain> gains;
  for (const model::Gain& gain : binding.method().gains) {
    if (!gain.indices.empty()) families[gain.name] = ranges(gain.indices, binding.names->design);
    for (const Member& member : members(gain.indices, {}, binding.names->design))
      gains.push_back({member.name_of(gain.name),
                       instantiate(gain.value, member, binding.names->design), gain.place,
                       gain.variable});
  }
  // A gain may use others, which are definitions to it.
  expr::Scope names = binding.names->design;
  names.families.insert(families.begin(), families.end());
  for (const model::Gain& gain : gains)
    if (gain.variable.empty() && !names.symbols.contains(gain.name))
      names.definitions.try_emplace(gain.name, expr::Definition{{}, gain.value});
  for (const model::Gain& gain : gains) add_gain(binding, gain, names);
  bind_gain_bounds(binding);
  binding.names->running = binding.names->design;
  expr::Scope& scope = binding.names->running;
  for (auto& [name, range] : families) scope.families[name] = std::move(range);
  for (const model::Design::Gain& gain : binding.design->gains) {
    if (!gain.variable.empty()) {
      scope.symbols.erase(gain.name);
      scope.functions[gain.name] = gain.shape;
    } else if (!scope.symbols.contains(gain.name)) {
      scope.symbols[gain.name] = {gain.shape};
    }
  }
  binding.names->results = scope;
  binding.names->results.symbols["objective"] = {};
}

/// Compiled over the names of runs; it may differ from the formula of the method.
expr::Program bind_gain_formula(const model::Instance& instance,
                                const std::vector<model::UnknownMatrix>& unknowns,
                                const std::string& text, const std::string& variable,
                                const Place& place) {
  expr::Scope scope = gain_scope(instance.design->names->running, variable);
  for (const model::UnknownMatrix& unknown : unknowns)
    scope.symbols[unknown.name] = {unknown.shape};
  scope.known = std::make_shared<numbers::KnownDoubles>(instance.values);
  return expr::compile(expr::parse(expr::Text::generated(text, place)), scope);
}

}  // namespace gainsmith::bind
