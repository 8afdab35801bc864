// maximum(f, x in [a, b], ...) and minimum: f as a program of its own in the names of the box and
// in what does not depend on them.
#include <algorithm>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "expr/binder.h"

namespace gainsmith::expr {

Bound Binder::extremum(const Expression& expression, const Node& node, bool largest) {
  const auto is_box = [](const NodePtr& child) { return child->kind == NodeKind::within; };
  if (is_box(node.children[0]) ||
      !std::all_of(node.children.begin() + 1, node.children.end(), is_box))
    fail(
        expression, node,
        node.text + " is written " + node.text + "(f, x in [a, b]), with a box for each name of f");
  std::vector<int> operands;
  std::vector<int> variables;
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
    variables.push_back(assembly_.add_input(box.text + " of maximum " + std::to_string(extrema_),
                                            shape(low), like));
    if (!environment.insert_or_assign(box.text, Bound{variables.back()}).second)
      fail(expression, box, "'" + box.text + "' already has a meaning here; name it otherwise");
  }
  std::swap(environment, environment_);
  const Node& term = *node.children[0];
  const int value = materialise(expression, term, bind(expression, term), {});
  std::swap(environment, environment_);
  const Inner found = inner(expression, node, value, variables);
  operands.insert(operands.end(), found.others.begin(), found.others.end());
  refuse_moving(expression, node, operands);
  return {emit(expression, node, Op::extremum, std::move(operands), {},
               {largest ? 1 : 0, static_cast<int>(variables.size())}, names, found.body)};
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

Binder::Inner Binder::inner(const Expression& expression, const Node& node, int value,
                            const std::vector<int>& variables) const {
  const auto end = static_cast<std::size_t>(std::max(value, std::ranges::max(variables))) + 1;
  std::vector<bool> depends(end), needed(end);
  for (const int variable : variables) depends[static_cast<std::size_t>(variable)] = true;
  for (std::size_t i = 0; i < end; ++i)
    for (const int operand : assembly_[static_cast<int>(i)].operands)
      if (depends[static_cast<std::size_t>(operand)]) depends[i] = true;
  needed[static_cast<std::size_t>(value)] = true;
  for (std::size_t i = end; i-- > 0;)
    if (needed[i] && depends[i])
      for (const int operand : assembly_[static_cast<int>(i)].operands)
        needed[static_cast<std::size_t>(operand)] = true;

  Inner result;
  Assembly body;
  std::vector<int> moved(end, -1);
  for (std::size_t k = 0; k < variables.size(); ++k)
    moved[static_cast<std::size_t>(variables[k])] =
        body.add_input(variable_name(k), shape(variables[k]), assembly_[variables[k]]);
  const auto inside = [&](int operand) {
    int& to = moved[static_cast<std::size_t>(operand)];
    if (to >= 0) return to;
    result.others.push_back(operand);
    to = body.add_input(other_name(result.others.size() - 1), shape(operand), assembly_[operand]);
    return to;
  };
  for (std::size_t i = 0; i < end; ++i) {
    if (!needed[i] || !depends[i] || moved[i] >= 0) continue;
    Instruction instruction = assembly_[static_cast<int>(i)];
    refuse_inside(expression, node, instruction);
    for (int& operand : instruction.operands) operand = inside(operand);
    moved[i] = body.add(std::move(instruction));
  }
  result.depends = depends[static_cast<std::size_t>(value)];
  result.body = std::make_shared<const Program>(body.extract(inside(value)));
  return result;
}

void Binder::refuse_inside(const Expression& expression, const Node& node,
                           const Instruction& instruction) const {
  if (instruction.op == Op::call)
    fail(expression, node,
         "'" + instruction.text + "' is a call of an unknown or a gain, which has no " + node.text +
             " here");
  if (node.text == "jacobian" && instruction.op == Op::jacobian)
    fail(expression, node, "a jacobian of a jacobian by the same variable is not computed");
  if (node.text != "jacobian" && instruction.op == Op::extremum)
    fail(expression, node,
         "a " + node.text +
             " of what is searched itself is not computed; of one kind, write one with "
             "the names of both: maximum(f, x in [a, b], u in [c, d])");
}

}  // namespace gainsmith::expr
