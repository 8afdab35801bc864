#include "expr/program/estimate.h"

#include <cstddef>
#include <vector>

#include "base/words.h"

namespace gainsmith::expr {

std::string to_string(Estimate estimate) {
  return word_of<Estimate::mixed>(
      estimate, {"", "estimate from below", "estimate from above", "from estimates"});
}

/// Forward over the code: an instruction with an operand that is an estimate is `mixed`, since a
/// value that is made of one is bounded from no side.
Estimate estimate_of(const Program& program,
                     const std::function<Estimate(const std::string& input)>& of_input) {
  std::vector<Estimate> found(program.code.size(), Estimate::none);
  for (std::size_t i = 0; i < program.code.size(); ++i) {
    const Instruction& instruction = program.code[i];
    if (instruction.op == Op::input) {
      found[i] = of_input(program.input_of(instruction).name);
      continue;
    }
    const bool is_search = instruction.op == Op::extremum;
    if (is_search)
      found[i] = instruction.attributes[0] != 0 ? Estimate::from_below : Estimate::from_above;
    for (const int operand : instruction.operands)
      if (found[static_cast<std::size_t>(operand)] != Estimate::none) found[i] = Estimate::mixed;
    if (!is_search && instruction.body && search_in(*instruction.body) != nullptr)
      found[i] = Estimate::mixed;
  }
  return found[static_cast<std::size_t>(program.result)];
}

const Instruction* search_in(const Program& program) {
  for (const Instruction& instruction : program.code) {
    if (instruction.op == Op::extremum) return &instruction;
    if (!instruction.body) continue;
    if (const Instruction* inside = search_in(*instruction.body)) return inside;
  }
  return nullptr;
}

}  // namespace gainsmith::expr
