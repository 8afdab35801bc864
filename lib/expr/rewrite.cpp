#include "expr/rewrite.h"

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <utility>

#include "expr/assembly.h"

namespace gainsmith::expr {

namespace {

Instruction operation(Op op, std::vector<int> operands, Shape shape, const Instruction& like) {
  return {op, std::move(operands), shape, {}, {}, like.origin, like.offset};
}

/// Adds the instructions of a program, calls replaced; its inputs stay inputs, but for `variable`,
/// which is the instruction `argument`. The index of its result.
int add_program(Assembly& assembly, const Program& program, const BodyOf* body,
                const std::string& variable = "", int argument = -1) {
  std::vector<int> moved;
  moved.reserve(program.code.size());
  for (const Instruction& instruction : program.code) {
    if (instruction.op == Op::input) {
      const Input& input = program.inputs[static_cast<std::size_t>(instruction.attributes[0])];
      const bool replaced = argument >= 0 && input.name == variable;
      moved.push_back(replaced ? argument
                               : assembly.add_input(input.name, input.shape, instruction));
      continue;
    }
    if (instruction.op == Op::call) {
      const int at = moved[static_cast<std::size_t>(instruction.operands[0])];
      if (body == nullptr) {
        moved.push_back(
            assembly.add_call(called_by(program, instruction), instruction.shape, at, instruction));
        continue;
      }
      const Body& found = (*body)(called_by(program, instruction), instruction);
      moved.push_back(add_program(assembly, found.program, body, found.variable, at));
      continue;
    }
    Instruction copy = instruction;
    for (int& operand : copy.operands) operand = moved[static_cast<std::size_t>(operand)];
    moved.push_back(assembly.add(std::move(copy)));
  }
  return moved[static_cast<std::size_t>(program.result)];
}

}  // namespace

Program link(const Program& program, const BodyOf& body) {
  if (program.functions.empty()) return program;
  Assembly assembly;
  return assembly.extract(add_program(assembly, program, &body));
}

const std::string& called_by(const Program& program, const Instruction& call) {
  return program.functions[static_cast<std::size_t>(call.attributes[0])].name;
}

std::vector<const Instruction*> calls_in(const Program& program) {
  std::vector<const Instruction*> calls;
  for (const Instruction& instruction : program.code)
    if (instruction.op == Op::call) calls.push_back(&instruction);
  return calls;
}

Program argument_of(const Program& program, const Instruction& call) {
  Program whole = program;
  whole.result = call.operands[0];
  Assembly assembly;
  return assembly.extract(add_program(assembly, whole, nullptr));
}

Composer::Composer(const Place& place) {
  like_.origin = std::make_shared<const Text>(Text::generated("", place));
}

int Composer::number(const std::string& decimal) {
  Instruction constant = like_;
  constant.text = decimal;
  return assembly_.add(std::move(constant));
}

int Composer::input(const std::string& name, Shape shape) {
  return assembly_.add_input(name, shape, like_);
}

int Composer::apply(Op op, std::vector<int> operands, Shape shape, std::array<int, 4> attributes) {
  Instruction made = operation(op, std::move(operands), shape, like_);
  made.attributes = attributes;
  return assembly_.add(std::move(made));
}

int Composer::program(const Program& program) { return add_program(assembly_, program, nullptr); }

Program combination(const std::vector<Program>& factors, const std::vector<std::string>& terms,
                    Shape shape, const Place& place) {
  Composer compose(place);
  const Op times = shape.is_scalar() ? Op::multiply : Op::scale;
  int sum = -1;
  for (std::size_t k = 0; k < terms.size(); ++k) {
    int term = compose.input(terms[k], shape);
    if (!factors[k].code.empty())
      term = compose.apply(times, {compose.program(factors[k]), term}, shape);
    sum = sum < 0 ? term : compose.apply(Op::add, {sum, term}, shape);
  }
  if (sum < 0) throw std::logic_error("a combination without terms");
  return compose.take(sum);
}

Program input_program(const std::string& name, Shape shape) {
  Composer compose({});
  return compose.take(compose.input(name, shape));
}

Program with_diagonal(const Program& program, const std::vector<std::string>& diagonal,
                      const std::string& name) {
  Assembly assembly;
  const int difference = add_program(assembly, program, nullptr);
  const Instruction like = assembly[difference];
  const Shape shape = like.shape;
  std::vector<int> numbers;
  for (const std::string& decimal : diagonal) {
    Instruction number = operation(Op::constant, {}, {}, like);
    number.text = decimal;
    numbers.push_back(assembly.add(std::move(number)));
  }
  int room = numbers.front();
  if (numbers.size() == 1) {
    room = assembly.add(operation(Op::identity, {room}, shape, like));
  } else {
    Instruction column = operation(Op::blocks, numbers, {shape.rows, 1}, like);
    column.attributes[0] = 1;
    room = assembly.add(
        operation(Op::diagonal_matrix, {assembly.add(std::move(column))}, shape, like));
  }
  if (!name.empty()) {
    const int scalar = assembly.add_input(name, {}, like);
    room = assembly.add(operation(Op::scale, {scalar, room}, shape, like));
  }
  return assembly.extract(assembly.add(operation(Op::add, {difference, room}, shape, like)));
}

}  // namespace gainsmith::expr
