#include "expr/binding/substitute.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <stdexcept>

#include "expr/program/assembly.h"

namespace gainsmith::expr {

namespace {

std::size_t index(int at) { return static_cast<std::size_t>(at); }

/// An assembly with products of several factors.
/// Products are flat lists of factors here: a factor beside its inverse is left out with it.
class Algebra {
 public:
  Assembly assembly;

  int apply(Op op, std::vector<int> operands, Shape shape, const Instruction& like) {
    return assembly.add(made(op, std::move(operands), shape, like));
  }

  /// left * right; as it is where nothing cancels, so that the order of operations stays.
  int times(int left, int right, const Instruction& like) {
    std::vector<int> factors;
    bool shorter = false;
    for (const int side : {left, right}) add_factors(side, factors, shorter);
    if (!shorter)
      return apply(Op::multiply, {left, right},
                   {assembly.shape(left).rows, assembly.shape(right).cols}, like);
    if (factors.empty()) return identity(assembly.shape(left).rows, like);
    int product = factors.front();
    for (std::size_t k = 1; k < factors.size(); ++k)
      product = apply(Op::multiply, {product, factors[k]},
                      {assembly.shape(product).rows, assembly.shape(factors[k]).cols}, like);
    return product;
  }

  /// inv(inv(A)) is A.
  int inverse(int square, const Instruction& like) {
    const Instruction& it = assembly[square];
    if (it.op == Op::inverse) return it.operands[0];
    return apply(Op::inverse, {square}, it.shape, like);
  }

  /// Adds an instruction whose operands are here.
  int add(const Instruction& instruction) {
    return instruction.op == Op::multiply
               ? times(instruction.operands[0], instruction.operands[1], instruction)
               : assembly.add(instruction);
  }

 private:
  bool are_inverse(int a, int b) const {
    const auto inverts = [&](int one, int other) {
      return assembly[one].op == Op::inverse && assembly[one].operands[0] == other;
    };
    return inverts(a, b) || inverts(b, a);
  }

  void add_factors(int at, std::vector<int>& factors, bool& shorter) const {
    if (assembly[at].op == Op::multiply) {
      for (const int operand : assembly[at].operands) add_factors(operand, factors, shorter);
    } else if (!factors.empty() && are_inverse(factors.back(), at)) {
      factors.pop_back();
      shorter = true;
    } else {
      factors.push_back(at);
    }
  }

  int identity(int size, const Instruction& like) {
    Instruction instruction{Op::constant, {}, {}, {}, "1", like.origin, like.offset};
    return apply(Op::identity, {assembly.add(std::move(instruction))}, {size, size}, like);
  }
};

/// Gives what replaces an input or a call, whose argument it has; none: it stays.
using Special =
    std::function<std::optional<int>(const std::string& name, std::optional<int> argument)>;

/// Adds a program; what each of its instructions became.
std::vector<int> add_all(Algebra& algebra, const Program& program, const Special& special = {}) {
  const auto replace = [&](const Instruction& instruction,
                           const Instruction& copy) -> std::optional<int> {
    if (instruction.op != Op::input && instruction.op != Op::call) return algebra.add(copy);
    if (!special) return std::nullopt;
    if (instruction.op == Op::input)
      return special(program.input_of(instruction).name, std::nullopt);
    return special(called_by(program, instruction), copy.operands.front());
  };
  return algebra.assembly.add_all(program, replace);
}

int add(Algebra& algebra, const Program& program, const Special& special = {}) {
  return add_all(algebra, program, special)[index(program.result)];
}

/// How often an instruction occurs in the formula of each: 0, 1, or more as 2.
std::vector<int> occurrences(const Program& program, int of) {
  std::vector<int> count(program.code.size(), 0);
  for (std::size_t at = 0; at < program.code.size(); ++at) {
    if (static_cast<int>(at) == of) count[at] = 1;
    for (const int operand : program.code[at].operands)
      count[at] = std::min(2, count[at] + count[index(operand)]);
  }
  return count;
}

/// Undoes the instruction `one` around its operand k: what that operand is when the result is
/// `value`. None: it cannot be undone.
std::optional<int> undone(Algebra& algebra, const Instruction& instruction, std::size_t k,
                          int value, const std::vector<int>& moved) {
  const Assembly& assembly = algebra.assembly;
  const auto other = [&] { return moved[index(instruction.operands[1 - k])]; };
  const Shape shape = assembly.shape(moved[index(instruction.operands[k])]);
  switch (instruction.op) {
    case Op::negate:
    case Op::transpose:
      return algebra.apply(instruction.op, {value}, shape, instruction);
    case Op::inverse:
      return algebra.inverse(value, instruction);
    case Op::add:
      return algebra.apply(Op::subtract, {value, other()}, shape, instruction);
    case Op::subtract:
      return k == 0 ? algebra.apply(Op::add, {value, other()}, shape, instruction)
                    : algebra.apply(Op::subtract, {other(), value}, shape, instruction);
    case Op::scale:
      if (k == 0) return std::nullopt;
      return algebra.apply(Op::scale, {algebra.inverse(other(), instruction), value}, shape,
                           instruction);
    case Op::divide:
      if (k == 1) return std::nullopt;
      if (shape.is_scalar()) return algebra.times(other(), value, instruction);
      return algebra.apply(Op::scale, {other(), value}, shape, instruction);
    case Op::multiply: {
      if (!assembly.shape(other()).is_square()) return std::nullopt;
      const int back = algebra.inverse(other(), instruction);
      return k == 0 ? algebra.times(value, back, instruction)
                    : algebra.times(back, value, instruction);
    }
    default:
      return std::nullopt;
  }
}

}  // namespace

/// The variable of a body is its own: no other name in it is replaced.
Program substitute(const Program& program, const Replacements& replacements) {
  Algebra algebra;
  const Special special = [&](const std::string& name,
                              std::optional<int> argument) -> std::optional<int> {
    if (!argument) {
      const auto found = replacements.inputs.find(name);
      if (found == replacements.inputs.end()) return std::nullopt;
      return add(algebra, found->second);
    }
    const auto found = replacements.functions.find(name);
    if (found == replacements.functions.end()) return std::nullopt;
    return add(algebra, found->second.program,
               [&](const std::string& inner, std::optional<int> call) -> std::optional<int> {
                 if (call || inner != found->second.variable) return std::nullopt;
                 return argument;
               });
  };
  const int result = add(algebra, program, special);
  return algebra.assembly.extract(result);
}

/// Program and parts are added to one assembly, where equal subexpressions are one instruction.
/// Then the program is cut at the instructions of the parts.
Program with_inputs(const Program& program,
                    const std::vector<std::pair<std::string, Program>>& parts) {
  if (!program.functions.empty()) throw std::logic_error("a call that was not linked");
  Algebra whole;
  std::map<int, std::string> known;
  for (const auto& [name, part] : parts) known.emplace(add(whole, part), name);
  const int result = add(whole, program);
  const Assembly& all = whole.assembly;
  std::vector<bool> needed(index(all.size()), false);
  needed[index(result)] = true;
  for (int at = all.size() - 1; at >= 0; --at)
    if (needed[index(at)] && !known.contains(at))
      for (const int operand : all[at].operands) needed[index(operand)] = true;
  Assembly made;
  std::vector<int> moved(index(all.size()), -1);
  for (int at = 0; at < all.size(); ++at) {
    if (!needed[index(at)]) continue;
    const Instruction& instruction = all[at];
    if (const auto part = known.find(at); part != known.end()) {
      moved[index(at)] = made.add_input(part->second, instruction.shape, instruction);
    } else if (instruction.op == Op::input) {
      moved[index(at)] =
          made.add_input(all.input_name(instruction), instruction.shape, instruction);
    } else {
      moved[index(at)] = made.add(expr::moved(instruction, moved));
    }
  }
  return made.extract(moved[index(result)]);
}

/// From the result down to the part, each operation is undone by its inverse: f(part) = value
/// becomes part = f^-1(value).
std::optional<Program> isolated(const Program& program, const std::string& part,
                                const std::string& variable, const std::string& value) {
  int target = -1;
  for (std::size_t at = 0; at < program.code.size(); ++at) {
    const Instruction& instruction = program.code[at];
    const bool is_part =
        (instruction.op == Op::input && program.input_of(instruction).name == part) ||
        (instruction.op == Op::call && called_by(program, instruction) == part);
    if (!is_part) continue;
    if (target >= 0) return std::nullopt;
    target = static_cast<int>(at);
  }
  if (target < 0) return std::nullopt;
  const Instruction& found = program.code[index(target)];
  if (found.op == Op::call) {
    const Instruction& argument = program.code[index(found.operands[0])];
    if (argument.op != Op::input || program.input_of(argument).name != variable)
      return std::nullopt;
  }
  const std::vector<int> count = occurrences(program, target);
  if (count[index(program.result)] != 1) return std::nullopt;
  Algebra algebra;
  const std::vector<int> moved = add_all(algebra, program);
  const Instruction& top = program.code[index(program.result)];
  int known = algebra.assembly.add_input(value, top.shape, top);
  for (int at = program.result; at != target;) {
    const Instruction& instruction = program.code[index(at)];
    std::size_t k = 0;
    while (count[index(instruction.operands[k])] == 0) ++k;
    const auto before = undone(algebra, instruction, k, known, moved);
    if (!before) return std::nullopt;
    known = *before;
    at = instruction.operands[k];
  }
  return algebra.assembly.extract(known);
}

}  // namespace gainsmith::expr
