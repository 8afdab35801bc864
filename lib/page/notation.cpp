// What names represent, from declarations, signatures and, for definitions, from their formulas: a
// name is a scalar where its formula is one for certain.
#include "page/notation.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>
#include <vector>

namespace gainsmith::page {

namespace {

using expr::Node;
using expr::NodeKind;

/// Of a run, and of unknowns: they are called, and are no functions of the language's table.
constexpr std::array<std::string_view, 5> kCalled = {"derivative", "count", "since", "passes",
                                                     "rate"};

/// Functions whose value is a number whatever their arguments are.
constexpr std::array<std::string_view, 12> kNumbersOfMatrices = {
    "norm",    "trace", "det",  "lambda_max", "lambda_min", "maximum",
    "minimum", "cond",  "rank", "count",      "since",      "passes"};

template <class Names>
bool holds(const Names& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Collects the names of a problem.
class Reader {
 public:
  explicit Reader(const model::Problem& problem) : problem_(problem), method_(*problem.method) {
    for (const std::string_view name : kCalled) found.functions.emplace(name);
  }

  void read() {
    for (const auto& datum : method_.data) declare(datum, !datum.arguments.empty());
    for (const auto& parameter : method_.parameters) found.scalars.insert(parameter.name);
    for (const auto& unknown : method_.unknowns) declare(unknown, !unknown.variable.empty());
    for (const auto& function : problem_.functions) sign(function.signature);
    for (const auto& gain : method_.gains) {
      if (!gain.variable.empty()) found.functions.insert(gain.name);
      if (!gain.indices.empty()) found.families.insert(gain.name);
    }
    component(method_.plant);
    for (const auto& observer : method_.observers) component(observer);
    for (const auto& observer : method_.observers) estimates(observer);
    for (const auto& signal : method_.signals) learn(signal.name, signal.value);
    // The hybrid time.
    found.scalars.insert({"t", "j"});
    // The order of definitions is free.
    for (int pass = 0; pass < 2; ++pass) {
      lets(method_.let);
      lets(problem_.let);
    }
  }

  Notation found;

 private:
  void declare(const model::Declaration& declaration, bool function) {
    if (function) found.functions.insert(declaration.name);
    if (!declaration.indices.empty()) found.families.insert(declaration.name);
    if (declaration.shape.structure == model::Structure::scalar)
      found.scalars.insert(declaration.name);
  }

  void sign(const expr::Signature& signature) {
    if (!signature.parameters.empty()) found.functions.insert(signature.name);
    if (!signature.indices.empty()) found.families.insert(signature.name);
  }

  /// Notes a scalar by its formula.
  void learn(const std::string& name, const expr::Expression& value) {
    if (value.root && is_scalar(*value.root, found)) found.scalars.insert(name);
  }

  void lets(const std::vector<model::Let>& definitions) {
    for (const model::Let& let : definitions) {
      sign(let.signature);
      learn(let.signature.name, let.body);
    }
  }

  void component(const model::Component& component) {
    for (const auto& state : component.states) declare(state, false);
    for (const auto& mode : component.modes) found.scalars.insert(mode.name);
    lets(component.let);
    for (const auto& reaction : component.at)
      for (const auto& pass : reaction.passes) lets(pass.let);
  }

  /// States of an observer that are called as a state or output of the plant with "h" or "_hat".
  void estimates(const model::Component& observer) {
    const auto estimate = [&](const std::string& of) {
      for (const char* ending : {"h", "_hat"})
        for (const auto& state : observer.states)
          if (state.name == of + ending) found.estimates[state.name] = of;
    };
    for (const auto& state : method_.plant.states) estimate(state.name);
    for (const auto& output : method_.plant.outputs) estimate(output.name);
  }

  const model::Problem& problem_;
  const model::Method& method_;
};

bool all_scalar(const std::vector<expr::NodePtr>& nodes, const Notation& notation) {
  return std::all_of(nodes.begin(), nodes.end(),
                     [&](const auto& node) { return is_scalar(*node, notation); });
}

bool has_range(const Node& node) {
  return std::any_of(node.children.begin(), node.children.end(),
                     [](const auto& child) { return child->kind == NodeKind::range; });
}

/// Functions of elements give a number where all arguments are numbers.
bool scalar_call(const Node& node, const Notation& notation) {
  constexpr std::array<std::string_view, 14> kElementwise = {"exp", "log", "log10", "sqrt", "sin",
                                                             "cos", "tan", "abs",   "sign", "floor",
                                                             "min", "max", "clip",  "inv"};
  const std::string& name = node.text;
  if (holds(kNumbersOfMatrices, name) || notation.scalars.contains(name)) return true;
  if (holds(kElementwise, name)) return all_scalar(node.children, notation);
  return false;
}

}  // namespace

Notation notation_of(const model::Problem& problem) {
  Reader reader(problem);
  reader.read();
  return std::move(reader.found);
}

bool is_scalar(const Node& node, const Notation& notation) {
  switch (node.kind) {
    case NodeKind::number:
      return true;
    case NodeKind::name:
      return node.text == "pi" || notation.scalars.contains(node.text);
    case NodeKind::call:
      return scalar_call(node, notation);
    case NodeKind::index: {
      const Node& of = *node.children.front();
      const bool called = of.kind == NodeKind::call && notation.functions.contains(of.text);
      if (called) return notation.scalars.contains(of.text);
      // A(i, j): the matrix and two indices.
      return node.children.size() == 3 && !has_range(node);
    }
    case NodeKind::negate:
    case NodeKind::transpose:
    case NodeKind::add:
    case NodeKind::subtract:
    case NodeKind::multiply:
    case NodeKind::divide:
    case NodeKind::power:
      return all_scalar(node.children, notation);
    default:
      return false;
  }
}

}  // namespace gainsmith::page
