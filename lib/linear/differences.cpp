#include "linear/differences.h"

#include <algorithm>
#include <stdexcept>

#include "expr/program/rewrite.h"

namespace gainsmith::linear {

namespace {

/// How many of the names a program uses.
std::size_t count_of(const expr::Program& program, const std::set<std::string>& names) {
  return static_cast<std::size_t>(
      std::count_if(program.inputs.begin(), program.inputs.end(),
                    [&](const expr::Input& input) { return names.contains(input.name); }));
}

/// The input that an operand is; none where it is something else.
const expr::Input* input_of(const expr::Program& program, int operand) {
  const expr::Instruction& instruction = program.code[static_cast<std::size_t>(operand)];
  if (instruction.op != expr::Op::input) return nullptr;
  return &program.input_of(instruction);
}

}  // namespace

/// Greedy, in the order of the texts: a - b is taken when neither is replaced yet and b is not kept
/// by another difference.
std::vector<StateDifference> find_differences(const std::vector<expr::Program>& functions,
                                              const hybrid::StateLayout& layout) {
  std::vector<StateDifference> found;
  std::set<std::string> kept;
  std::set<std::string> replaced;
  const auto is_state = [&](const std::string& name) {
    return name != layout.timer && layout.moves(name);
  };
  for (const expr::Program& program : functions)
    for (const expr::Instruction& instruction : program.code) {
      if (instruction.op != expr::Op::subtract) continue;
      const expr::Input* a = input_of(program, instruction.operands[0]);
      const expr::Input* b = input_of(program, instruction.operands[1]);
      if (a == nullptr || b == nullptr || a->name == b->name) continue;
      if (!is_state(a->name) || !is_state(b->name)) continue;
      if (replaced.contains(a->name) || replaced.contains(b->name) || kept.contains(b->name))
        continue;
      kept.insert(a->name);
      replaced.insert(b->name);
      found.push_back({a->name + " - " + b->name, a->name, b->name, b->shape});
    }
  return found;
}

ErrorRewriting::ErrorRewriting(const std::vector<StateDifference>& differences,
                               const hybrid::StateLayout& layout) {
  for (const StateDifference& pair : differences) {
    by_[pair.minus] = difference(expr::input_program(pair.plus, pair.shape),
                                 expr::input_program(pair.name, pair.shape));
    names_.insert(pair.name);
  }
  for (const hybrid::Slot& slot : layout.slots)
    if (!by_.contains(slot.name)) names_.insert(slot.name);
}

expr::Program ErrorRewriting::operator()(const expr::Program& program) {
  return simplified(replace_inputs(program, by_));
}

expr::Program ErrorRewriting::simplified(const expr::Program& program) {
  try {
    expr::Program other = polynomials_.program(polynomials_.of(program));
    if (count_of(other, names_) < count_of(program, names_)) return other;
  } catch (const std::length_error&) {
    // The polynomial has too many words: the text stays as it is.
  }
  return program;
}

}  // namespace gainsmith::linear
