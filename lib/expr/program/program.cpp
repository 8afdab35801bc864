#include "expr/program/program.h"

#include <algorithm>
#include <string>
#include <utility>

namespace gainsmith::expr {

Instruction made(Op op, std::vector<int> operands, Shape shape, const Instruction& like,
                 Attributes attributes) {
  return {op, std::move(operands), shape, attributes, {}, like.origin, like.offset};
}

Instruction moved(Instruction instruction, const std::vector<int>& to) {
  for (int& operand : instruction.operands) operand = to[static_cast<std::size_t>(operand)];
  return instruction;
}

/// "the variable", "the variable 2", ...: no name of the language has a space, so that none is
/// captured.
std::string variable_name(std::size_t k) {
  return k == 0 ? "the variable" : "the variable " + std::to_string(k + 1);
}

std::string other_name(std::size_t k) { return "operand " + std::to_string(k + 1); }

/// Instruction by instruction; programs that differ in the order of their instructions are not the
/// same.
bool is_same(const Program& a, const Program& b) {
  const auto same_input = [](const Input& x, const Input& y) {
    return x.name == y.name && x.shape == y.shape;
  };
  const auto same_instruction = [](const Instruction& x, const Instruction& y) {
    return x.op == y.op && x.operands == y.operands && x.shape == y.shape &&
           x.attributes == y.attributes && x.text == y.text &&
           (x.body == y.body || (x.body && y.body && is_same(*x.body, *y.body)));
  };
  return a.result == b.result && std::ranges::equal(a.inputs, b.inputs, same_input) &&
         std::ranges::equal(a.functions, b.functions, same_input) &&
         std::ranges::equal(a.code, b.code, same_instruction);
}

int Bodies::number_of(const std::shared_ptr<const Program>& body) {
  if (!body) return -1;
  const auto found = std::ranges::find_if(
      known_, [&](const auto& known) { return known == body || is_same(*known, *body); });
  if (found != known_.end()) return static_cast<int>(found - known_.begin());
  known_.push_back(body);
  return static_cast<int>(known_.size()) - 1;
}

int Program::input(const std::string& name) const {
  for (std::size_t i = 0; i < inputs.size(); ++i)
    if (inputs[i].name == name) return static_cast<int>(i);
  return -1;
}

}  // namespace gainsmith::expr
