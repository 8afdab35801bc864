#include "expr/assembly.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace gainsmith::expr {

namespace {

/// The place of a name in a list of inputs, added when it is not there.
int place_of(std::vector<Input>& inputs, const std::string& name, Shape shape) {
  for (std::size_t i = 0; i < inputs.size(); ++i)
    if (inputs[i].name == name) return static_cast<int>(i);
  inputs.push_back({name, shape});
  return static_cast<int>(inputs.size()) - 1;
}

Instruction made(Op op, std::vector<int> operands, Shape shape, int attribute,
                 const Instruction& like) {
  return {op, std::move(operands), shape, {attribute}, {}, like.origin, like.offset};
}

}  // namespace

int Assembly::add(Instruction instruction) {
  std::vector<Shape> operands;
  operands.reserve(instruction.operands.size());
  for (const int operand : instruction.operands) operands.push_back(shape(operand));
  if (result_shape(instruction.op, operands, instruction.attributes, instruction.shape) !=
      instruction.shape)
    throw std::logic_error("a " + to_string(instruction.op) + " of a wrong shape, " +
                           to_string(instruction.shape));
  const Key key{instruction.op,
                instruction.operands,
                instruction.shape.rows,
                instruction.shape.cols,
                instruction.attributes,
                instruction.text,
                number_of(instruction.body)};
  const auto [found, fresh] = known_.emplace(key, static_cast<int>(program_.code.size()));
  if (fresh) program_.code.push_back(std::move(instruction));
  return found->second;
}

int Assembly::number_of(const std::shared_ptr<const Program>& body) {
  if (!body) return -1;
  const auto found = std::ranges::find_if(
      bodies_, [&](const auto& known) { return known == body || is_same(*known, *body); });
  if (found == bodies_.end()) {
    bodies_.push_back(body);
    return static_cast<int>(bodies_.size()) - 1;
  }
  return static_cast<int>(found - bodies_.begin());
}

int Assembly::add_input(const std::string& name, Shape shape, const Instruction& like) {
  return add(made(Op::input, {}, shape, place_of(program_.inputs, name, shape), like));
}

int Assembly::add_call(const std::string& name, Shape shape, int argument,
                       const Instruction& like) {
  Instruction call =
      made(Op::call, {argument}, shape, place_of(program_.functions, name, shape), like);
  call.text = like.text;
  return add(std::move(call));
}

Program Assembly::extract(int at) const {
  std::vector<bool> needed(program_.code.size(), false);
  needed[static_cast<std::size_t>(at)] = true;
  for (std::size_t i = program_.code.size(); i-- > 0;)
    if (needed[i])
      for (const int operand : program_.code[i].operands)
        needed[static_cast<std::size_t>(operand)] = true;
  Program result;
  std::vector<int> moved(program_.code.size(), -1);
  for (std::size_t i = 0; i < program_.code.size(); ++i) {
    if (!needed[i]) continue;
    Instruction instruction = program_.code[i];
    for (int& operand : instruction.operands) operand = moved[static_cast<std::size_t>(operand)];
    if (instruction.op == Op::input || instruction.op == Op::call) {
      const bool input = instruction.op == Op::input;
      const auto& all = input ? program_.inputs : program_.functions;
      const Input& named = all[static_cast<std::size_t>(instruction.attributes[0])];
      instruction.attributes[0] =
          place_of(input ? result.inputs : result.functions, named.name, named.shape);
    }
    result.code.push_back(std::move(instruction));
    moved[i] = static_cast<int>(result.code.size()) - 1;
  }
  result.result = moved[static_cast<std::size_t>(at)];
  return result;
}

}  // namespace gainsmith::expr
