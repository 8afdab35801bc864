// What jacobian(e, x), flow_map(e, x, d) and project_convex(x, P, e) have in common: e as a
// function of the name x.
#include <algorithm>
#include <utility>

#include "expr/binding/binder.h"

namespace gainsmith::expr {

/// A symbol is varied itself. A parameter or a definition gets an input of its own, since its value
/// may also occur in e in other ways.
Binder::Varied Binder::varied(const Expression& expression, const Node& node, std::size_t value_at,
                              std::size_t variable_at, bool rate) {
  const Node& value_node = *node.children[value_at];
  const Node& variable_node = *node.children[variable_at];
  const std::string& name = variable_node.text;
  const auto definition = scope_.definitions.find(name);
  const bool is_parameter = environment_.contains(name);
  const bool is_symbol = scope_.symbols.contains(name);
  const bool is_definition =
      definition != scope_.definitions.end() && definition->second.parameters.empty();
  if (variable_node.kind != NodeKind::name)
    fail(expression, variable_node,
         std::string(find_function(node.text)->usage) +
             " needs a name x - a state, an output, a datum, a definition or one of its "
             "parameters -, not '" +
             expression.quote(variable_node) + "'");
  const int point = sized(expression, variable_node, bind_name(expression, variable_node));
  if (!is_parameter && !is_symbol && !is_definition)
    fail(expression, variable_node, "'" + name + "' is a number that nothing varies");
  const auto value = [&] {
    const Bound bound = bind(expression, value_node);
    return rate ? materialise(expression, value_node, bound, shape(point))
                : sized(expression, value_node, bound);
  };
  if (!is_parameter && is_symbol) return {value(), point, point};

  // A parameter may represent the value of any expression, also of one that e holds elsewhere: an
  // input of its own takes its place. So it is with a definition, in all others that use it.
  Instruction like;
  like.origin = expression.text;
  like.offset = variable_node.begin;
  const int variable = assembly_.add_input(
      name + " of " + node.text + " " + std::to_string(++varied_), shape(point), like);
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
  return {of, variable, point};
}

/// One pass forwards: an instruction depends on a variable where one of its operands does.
std::vector<bool> Binder::depending_on(const std::vector<int>& variables, int until) const {
  const int last = std::max(until, *std::max_element(variables.begin(), variables.end()));
  std::vector<bool> depends(static_cast<std::size_t>(last) + 1);
  for (const int variable : variables) depends[static_cast<std::size_t>(variable)] = true;
  for (int i = 0; i <= until; ++i)
    for (const int operand : assembly_[i].operands)
      if (depends[static_cast<std::size_t>(operand)]) depends[static_cast<std::size_t>(i)] = true;
  return depends;
}

/// The instructions between the variables and the value are copied to a program of their own. What
/// they read besides becomes inputs "operand k", so that it is computed once outside of the body.
Binder::Body Binder::body_of(int value, const std::vector<std::pair<int, std::string>>& inputs,
                             std::size_t first) const {
  std::vector<int> variables;
  for (const auto& input : inputs) variables.push_back(input.first);
  const std::vector<bool> depends = depending_on(variables, value);
  std::vector<bool> needed(depends.size());
  needed[static_cast<std::size_t>(value)] = true;
  for (auto i = static_cast<std::size_t>(value) + 1; i-- > 0;)
    if (needed[i] && depends[i])
      for (const int operand : assembly_[static_cast<int>(i)].operands)
        needed[static_cast<std::size_t>(operand)] = true;

  Body body;
  std::vector<int> moved(depends.size(), -1);
  for (const auto& [at, name] : inputs)
    moved[static_cast<std::size_t>(at)] =
        body.assembly.add_input(name, assembly_.shape(at), assembly_[at]);
  const auto inside = [&](int operand) {
    int& to = moved[static_cast<std::size_t>(operand)];
    if (to < 0) {
      to = body.assembly.add_input("operand " + std::to_string(first + body.outside.size()),
                                   assembly_.shape(operand), assembly_[operand]);
      body.outside.push_back(operand);
    }
    return to;
  };
  for (int i = 0; i <= value; ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (!needed[at] || !depends[at] || moved[at] >= 0) continue;
    Instruction instruction = assembly_[i];
    body.operations.insert(instruction.op);
    if (instruction.op == Op::call && body.call.empty()) body.call = instruction.text;
    for (int& operand : instruction.operands) operand = inside(operand);
    moved[at] = body.assembly.add(std::move(instruction));
  }
  body.result = inside(value);
  return body;
}

}  // namespace gainsmith::expr
