#include "expr/program/assembly.h"

#include <stdexcept>

#include "expr/program/rewrite.h"

namespace gainsmith::expr {

namespace {

/// The place of a name in a list of inputs, added when it is not there.
int place_of(std::vector<Input>& inputs, const std::string& name, Shape shape) {
  for (std::size_t i = 0; i < inputs.size(); ++i)
    if (inputs[i].name == name) return static_cast<int>(i);
  inputs.push_back({name, shape});
  return static_cast<int>(inputs.size()) - 1;
}

}  // namespace

/// The key of an instruction is its operation, operands, shape, attributes, text and body; its
/// place is not part of it. The first place is kept.
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
                bodies_.number_of(instruction.body)};
  const auto [found, fresh] = known_.emplace(key, static_cast<int>(program_.code.size()));
  if (fresh) program_.code.push_back(std::move(instruction));
  return found->second;
}

/// One input for each name.
int Assembly::add_input(const std::string& name, Shape shape, const Instruction& like) {
  return add(made(Op::input, {}, shape, like, {place_of(program_.inputs, name, shape)}));
}

int Assembly::add_call(const std::string& name, Shape shape, int argument,
                       const Instruction& like) {
  Instruction call =
      made(Op::call, {argument}, shape, like, {place_of(program_.functions, name, shape)});
  call.text = like.text;
  return add(std::move(call));
}

/// Inputs and functions are found by name, as their numbers differ between programs.
int Assembly::add_copy(const Program& program, Instruction copy) {
  if (copy.op != Op::input && copy.op != Op::call) return add(std::move(copy));
  if (copy.op == Op::call)
    return add_call(called_by(program, copy), copy.shape, copy.operands[0], copy);
  const Input& input = program.input_of(copy);
  return add_input(input.name, input.shape, copy);
}

int Assembly::add_program(const Program& program) {
  return add_program(program, [](const auto&, const auto&) { return std::nullopt; });
}

/// One pass backwards marks what is needed, one forwards copies it with new numbers.
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
    Instruction instruction = expr::moved(program_.code[i], moved);
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
