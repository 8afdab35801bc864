#include "expr/binding/partial_derivative.h"

#include <algorithm>
#include <map>
#include <optional>
#include <ranges>
#include <string>
#include <utility>

#include "expr/binding/compile.h"

namespace gainsmith::expr {

namespace {

using Key = std::pair<Op, std::size_t>;

std::map<Key, Program> compile_all() {
  std::map<Key, Program> programs;
  for (const NumberFunction& function : kNumberFunctions) {
    if (!has_derivatives(function.op)) continue;
    std::vector<std::string> parameters;
    Scope scope;
    for (const auto part : std::views::split(function.parameters, std::string_view(", ")))
      scope.symbols[parameters.emplace_back(part.begin(), part.end())] = {};
    for (std::size_t k = 0; k < parameters.size(); ++k) {
      const Text text(std::string(function.derivatives[k]), to_string(function.op));
      Program& program = programs[{function.op, k}] = compile(parse(text), scope);
      for (Input& input : program.inputs)
        input.name = std::to_string(std::ranges::find(parameters, input.name) - parameters.begin());
    }
  }
  return programs;
}

/// The operation that does element by element what this one does with numbers.
Op elementwise(Op op) {
  switch (op) {
    case Op::multiply:
    case Op::scale:
      return Op::elementwise_product;
    case Op::divide:
      return Op::elementwise_quotient;
    case Op::power:
      return Op::elementwise_power;
    default:
      return op;
  }
}

}  // namespace

const Program& partial_derivative(Op op, std::size_t k) {
  static const std::map<Key, Program> all = compile_all();
  return all.at({op, k});
}

int add_partial_derivative(Assembly& assembly, const Instruction& like, std::size_t k,
                           const std::vector<int>& operands) {
  const Program& program = partial_derivative(like.op, k);
  const auto replace = [&](const Instruction& original, Instruction copy) -> std::optional<int> {
    if (original.op == Op::input) return operands.at(std::stoul(program.input_of(original).name));
    // A condition x >= 0 is compiled as x - 0.
    if (original.op == Op::subtract &&
        program.code[static_cast<std::size_t>(original.operands[1])].text == "0")
      return copy.operands[0];
    copy.origin = like.origin;
    copy.offset = like.offset;
    copy.op = elementwise(copy.op);
    const bool fills = copy.op == Op::constant && !like.shape.is_scalar();
    if (!fills) copy.shape = like.shape;
    const int at = assembly.add(std::move(copy));
    return fills ? assembly.add(made(Op::fill, {at}, like.shape, like)) : at;
  };
  return assembly.add_program(program, replace);
}

}  // namespace gainsmith::expr
