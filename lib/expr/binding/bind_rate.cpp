// rate(v): the derivative of v along flows.
//
// With x_k the symbols that flow, x_k' = f_k, it is the derivative of v(x_1 + s f_1, x_2 + s f_2,
// ...) by the number s at s = 0: one direction for dual numbers, however many states there are.
#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "expr/binding/binder.h"

namespace gainsmith::expr {

/// A scope has definitions "rate(x)" only where runs are meant.
Bound Binder::rate(const Expression& expression, const Node& node) {
  const std::string prefix = "rate(";
  const auto first = scope_.definitions.lower_bound(prefix);
  if (first == scope_.definitions.end() || !first->first.starts_with(prefix))
    fail(expression, node,
         "rate(v) is the derivative of v along flows: it is for signals, claims and figures");
  const Node& argument = *node.children[0];
  const int value = sized(expression, argument, bind(expression, argument));
  if (shape(value).cols != 1)
    fail(expression, argument,
         "rate(v) is of a number or a column, not " + describe(expression, argument, {value}));
  return derivative_along(expression, node, value, rates_of(expression, node, value));
}

/// The rates of the symbols on which a value depends, by their instructions.
std::map<int, int> Binder::rates_of(const Expression& expression, const Node& node, int value) {
  const Program program = extract(value);
  std::map<int, int> rates;
  for (const Input& input : program.inputs) {
    const std::string name = rate_name(input.name);
    if (!scope_.definitions.contains(name)) continue;
    Instruction like;
    like.origin = expression.text;
    like.offset = node.begin;
    const int symbol = assembly_.add_input(input.name, input.shape, like);
    int rate =
        materialise(expression, node, bind_definition(expression, node, name, {}), input.shape);
    if (const std::string frozen = frozen_name(input.name); scope_.definitions.contains(frozen)) {
      const int rests =
          materialise(expression, node, bind_definition(expression, node, frozen, {}), Shape{});
      const int all = same_shape(expression, node, {rests}, input.shape);
      const int none = emit(expression, node, Op::zeros, {}, input.shape);
      rate = emit(expression, node, Op::where, {all, none, rate}, input.shape, {1});
    }
    rates[symbol] = rate;
  }
  return rates;
}

/// v(x + s f) as a body with the variable s, whose jacobian at s = 0 is v'(x) f, size(v) x 1. What
/// v does not need of the flow stays outside.
Bound Binder::derivative_along(const Expression& expression, const Node& node, int value,
                               const std::map<int, int>& rates) {
  const Shape result{shape(value).size(), 1};
  const auto end = static_cast<std::size_t>(value) + 1;
  std::vector<bool> depends(end);
  for (std::size_t i = 0; i < end; ++i) {
    depends[i] = rates.contains(static_cast<int>(i));
    for (const int operand : assembly_[static_cast<int>(i)].operands)
      if (depends[static_cast<std::size_t>(operand)]) depends[i] = true;
  }
  if (!depends[end - 1]) return {emit(expression, node, Op::zeros, {}, result)};
  std::vector<bool> needed(end);
  needed[end - 1] = true;
  for (std::size_t i = end; i-- > 0;)
    if (needed[i] && depends[i])
      for (const int operand : assembly_[static_cast<int>(i)].operands)
        needed[static_cast<std::size_t>(operand)] = true;

  Assembly body;
  const Instruction like = assembly_[value];  // it moves with what is added
  std::vector<int> operands = {number(expression, node, "0")};
  const int s = body.add_input("the variable", {}, like);
  const auto outside = [&](int operand) {
    const auto found = std::find(operands.begin() + 1, operands.end(), operand);
    const auto at = found - operands.begin();
    if (found == operands.end()) operands.push_back(operand);
    return body.add_input("operand " + std::to_string(at), shape(operand), assembly_[operand]);
  };
  const auto made = [&](Op op, std::vector<int> of, Shape shape) {
    return body.add(expr::made(op, std::move(of), shape, like));
  };
  std::vector<int> moved(end, -1);
  for (std::size_t i = 0; i < end; ++i) {
    if (!needed[i]) continue;
    const int at = static_cast<int>(i);
    if (!depends[i]) {
      moved[i] = outside(at);
    } else if (const auto rate = rates.find(at); rate != rates.end()) {
      const Shape of = shape(at);
      const int x = outside(at);
      const int step =
          made(of.is_scalar() ? Op::multiply : Op::scale, {s, outside(rate->second)}, of);
      moved[i] = made(Op::add, {x, step}, of);
    } else {
      const Instruction& instruction = assembly_[at];
      if (instruction.op == Op::jacobian)
        fail(expression, node, "rate: what holds a jacobian or a rate has none here");
      if (instruction.op == Op::call)
        fail(expression, node,
             "rate: '" + instruction.text +
                 "' is a call of an unknown or a gain, which has no derivative here");
      moved[i] = body.add(expr::moved(instruction, moved));
    }
  }
  auto program = std::make_shared<const Program>(body.extract(moved[end - 1]));
  return {emit(expression, node, Op::jacobian, std::move(operands), result, {}, {},
               std::move(program))};
}

}  // namespace gainsmith::expr
