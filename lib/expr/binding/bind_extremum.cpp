// maximum(f, x in [a, b], ...) and minimum: f as a program of its own in the names of the box.
#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "expr/binding/binder.h"

namespace gainsmith::expr {

/// The names of the box are inputs of the body, "the variable", "the variable 2", .... Operands are
/// the ends of all intervals, low and high in turn, then what f reads besides.
Bound Binder::extremum(const Expression& expression, const Node& node, bool largest) {
  const auto is_box = [](const NodePtr& child) { return child->kind == NodeKind::within; };
  if (is_box(node.children[0]) ||
      !std::all_of(node.children.begin() + 1, node.children.end(), is_box))
    fail(
        expression, node,
        node.text + " is written " + node.text + "(f, x in [a, b]), with a box for each name of f");
  std::vector<int> operands;
  std::vector<std::pair<int, std::string>> variables;
  std::string names;
  auto environment = environment_;
  Instruction like;
  like.origin = expression.text;
  ++extrema_;
  for (std::size_t k = 1; k < node.children.size(); ++k) {
    const Node& box = *node.children[k];
    const auto [low, high] = ends_of_box(expression, box);
    operands.insert(operands.end(), {low, high});
    like.offset = box.begin;
    names += (names.empty() ? "" : " ") + box.text;
    const int variable =
        assembly_.add_input(box.text + " of maximum " + std::to_string(extrema_), shape(low), like);
    variables.emplace_back(variable, variable_name(k - 1));
    if (!environment.insert_or_assign(box.text, Bound{variable}).second)
      fail(expression, box, "'" + box.text + "' already has a meaning here; name it otherwise");
  }
  std::swap(environment, environment_);
  const Node& term = *node.children[0];
  const int value = materialise(expression, term, bind(expression, term), {});
  std::swap(environment, environment_);
  const Body body = body_of(value, variables, 1);
  refuse_inside(expression, node, body);
  operands.insert(operands.end(), body.outside.begin(), body.outside.end());
  refuse_moving(expression, node, operands);
  auto program = std::make_shared<const Program>(body.assembly.extract(body.result));
  return {emit(expression, node, Op::extremum, std::move(operands), {},
               {largest ? 1 : 0, static_cast<int>(variables.size())}, names, std::move(program))};
}

std::pair<int, int> Binder::ends_of_box(const Expression& expression, const Node& box) {
  const std::string& name = box.text;
  if (scope_.symbols.contains(name) || scope_.dimensions.contains(name) ||
      scope_.definitions.contains(name) || scope_.functions.contains(name) ||
      scope_.families.contains(name))
    fail(expression, box, "'" + name + "' already has a meaning here; name it otherwise");
  const auto end = [&](std::size_t i) {
    const Node& child = *box.children[i];
    return sized(expression, child, bind(expression, child));
  };
  const int low = end(0);
  const int high = end(1);
  const Shape common = shape(shape(low).is_scalar() ? high : low);
  return {same_shape(expression, *box.children[0], {low}, common),
          same_shape(expression, *box.children[1], {high}, common)};
}

/// A search at each instant of a run would be no formula: it is over constants.
void Binder::refuse_moving(const Expression& expression, const Node& node,
                           const std::vector<int>& operands) const {
  for (const int operand : operands)
    for (const Input& input : extract(operand).inputs)
      if (const auto found = scope_.symbols.find(input.name);
          found != scope_.symbols.end() && found->second.moves)
        fail(expression, node,
             node.text + " is over constants - data, gains, definitions of them -, and '" +
                 input.name + "' changes along a run");
}

/// A search within a search would be evaluated at every point of the outer one.
void Binder::refuse_inside(const Expression& expression, const Node& node, const Body& body) const {
  if (!body.call.empty())
    fail(expression, node,
         "'" + body.call + "' is a call of an unknown or a gain, which has no " + node.text +
             " here");
  if (body.operations.contains(Op::extremum))
    fail(expression, node,
         "a " + node.text +
             " of what is searched itself is not computed; of one kind, write one with "
             "the names of both: maximum(f, x in [a, b], u in [c, d])");
}

}  // namespace gainsmith::expr
