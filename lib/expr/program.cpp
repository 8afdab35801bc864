#include "expr/program.h"

#include <algorithm>
#include <string>

namespace gainsmith::expr {

std::string variable_name(std::size_t k) {
  return k == 0 ? "the variable" : "the variable " + std::to_string(k + 1);
}

std::string other_name(std::size_t k) { return "operand " + std::to_string(k + 1); }

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

int Program::input(const std::string& name) const {
  for (std::size_t i = 0; i < inputs.size(); ++i)
    if (inputs[i].name == name) return static_cast<int>(i);
  return -1;
}

}  // namespace gainsmith::expr
