#include "expr/program/rewrite.h"

#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include "expr/program/assembly.h"

namespace gainsmith::expr {

namespace {

/// Adds the instructions of a program, calls replaced; its inputs stay inputs, but for `variable`,
/// which is the instruction `argument`. The index of its result.
int add_linked(Assembly& assembly, const Program& program, const BodyOf& body,
               const std::string& variable = "", int argument = -1) {
  const auto replace = [&](const Instruction& instruction,
                           const Instruction& copy) -> std::optional<int> {
    if (instruction.op == Op::input && argument >= 0 &&
        program.input_of(instruction).name == variable)
      return argument;
    if (instruction.op != Op::call) return std::nullopt;
    const Body& found = body(called_by(program, instruction), instruction);
    return add_linked(assembly, found.program, body, found.variable, copy.operands[0]);
  };
  return assembly.add_program(program, replace);
}

}  // namespace

/// Calls within bodies are linked on the way, however deep.
Program link(const Program& program, const BodyOf& body) {
  if (program.functions.empty()) return program;
  Assembly assembly;
  return assembly.extract(add_linked(assembly, program, body));
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

/// The subprogram of the operand of the call.
Program argument_of(const Program& program, const Instruction& call) {
  Program whole = program;
  whole.result = call.operands[0];
  Assembly assembly;
  return assembly.extract(assembly.add_program(whole));
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
  return assembly_.add(made(op, std::move(operands), shape, like_, attributes));
}

int Composer::program(const Program& program) { return assembly_.add_program(program); }

/// f_1 T_1 + f_2 T_2 + ... from left to right.
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

/// P + s D as add(P, scale(s, D)).
Program with_diagonal(const Program& program, const std::vector<std::string>& diagonal,
                      const std::string& name) {
  Assembly assembly;
  const int difference = assembly.add_program(program);
  const Instruction like = assembly[difference];
  const Shape shape = like.shape;
  std::vector<int> numbers;
  for (const std::string& decimal : diagonal) {
    Instruction number = made(Op::constant, {}, {}, like);
    number.text = decimal;
    numbers.push_back(assembly.add(std::move(number)));
  }
  int room = numbers.front();
  if (numbers.size() == 1) {
    room = assembly.add(made(Op::identity, {room}, shape, like));
  } else {
    const int column = assembly.add(made(Op::blocks, numbers, {shape.rows, 1}, like, {1}));
    room = assembly.add(made(Op::diagonal_matrix, {column}, shape, like));
  }
  if (!name.empty()) {
    const int scalar = assembly.add_input(name, {}, like);
    room = assembly.add(made(Op::scale, {scalar, room}, shape, like));
  }
  return assembly.extract(assembly.add(made(Op::add, {difference, room}, shape, like)));
}

}  // namespace gainsmith::expr
