// jacobian(e, x): e as a program of its own in x and in what does not depend on x.
#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "expr/binder.h"

namespace gainsmith::expr {

Bound Binder::jacobian(const Expression& expression, const Node& node) {
  const Node& value_node = *node.children[0];
  const Node& variable_node = *node.children[1];
  const std::string& name = variable_node.text;
  const auto definition = scope_.definitions.find(name);
  const bool is_parameter = environment_.contains(name);
  const bool is_symbol = scope_.symbols.contains(name);
  const bool is_definition =
      definition != scope_.definitions.end() && definition->second.parameters.empty();
  if (variable_node.kind != NodeKind::name)
    fail(expression, variable_node,
         "jacobian(e, x) needs a name x - a state, an output, a datum, a definition or one of its "
         "parameters -, not '" +
             expression.quote(variable_node) + "'");
  const int point = sized(expression, variable_node, bind_name(expression, variable_node));
  if (!is_parameter && !is_symbol && !is_definition)
    fail(expression, variable_node, "'" + name + "' is a number that nothing varies");
  const auto value = [&] { return sized(expression, value_node, bind(expression, value_node)); };
  if (!is_parameter && is_symbol) return derivative_by(expression, node, value(), point, point);

  // A parameter may stand for the value of any expression, also of one that e holds elsewhere: an
  // input of its own takes its place. So it is with a definition, in all others that use it.
  Instruction like;
  like.origin = expression.text;
  like.offset = variable_node.begin;
  const int variable = assembly_.add_input(name + " of jacobian " + std::to_string(++jacobians_),
                                           shape(point), like);
  auto environment = environment_;
  auto defined = defined_;
  if (is_parameter) {
    environment_[name] = {variable};
  } else {
    defined_ = {{name, {variable}}};
  }
  const int of = value();
  environment_ = std::move(environment);
  defined_ = std::move(defined);
  return derivative_by(expression, node, of, variable, point);
}

/// `variable`: the instruction that `value` is a function of; `point`: the one with its value.
Bound Binder::derivative_by(const Expression& expression, const Node& node, int value, int variable,
                            int point) {
  const Shape result{shape(value).size(), shape(variable).size()};
  Inner found = inner(expression, node, value, {variable});
  if (!found.depends) return {emit(expression, node, Op::zeros, {}, result)};
  std::vector<int> operands = {point};
  operands.insert(operands.end(), found.others.begin(), found.others.end());
  return {emit(expression, node, Op::jacobian, std::move(operands), result, {}, {},
               std::move(found.body))};
}

}  // namespace gainsmith::expr
