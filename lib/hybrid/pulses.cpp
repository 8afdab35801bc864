#include "hybrid/pulses.h"

#include <algorithm>
#include <vector>

#include "numbers/types/degree.h"

namespace gainsmith::hybrid {

namespace {

using expr::Instruction;
using expr::Op;

/// By instruction, whether a sine or cosine is part of it.
std::vector<char> waves_of(const expr::Program& program) {
  std::vector<char> waves;
  for (const Instruction& instruction : program.code)
    waves.push_back(instruction.op == Op::sin || instruction.op == Op::cos ||
                    std::ranges::any_of(instruction.operands, [&](int operand) {
                      return waves[static_cast<std::size_t>(operand)] != 0;
                    }));
  return waves;
}

}  // namespace

bool has_pulses(const expr::Program& program,
                const std::function<bool(const std::string&)>& is_clock) {
  if (std::ranges::none_of(program.inputs,
                           [&](const expr::Input& input) { return is_clock(input.name); }))
    return false;
  const std::vector<numbers::Degree> degrees = numbers::degrees(program, is_clock);
  const std::vector<char> waves = waves_of(program);
  // Not affine in clocks, and no sine in it: such an argument turns once, as (t - 5)^2 does.
  const auto turns_alone = [&](int operand) {
    const auto at = static_cast<std::size_t>(operand);
    return degrees[at] == numbers::kNotAffine && waves[at] == 0;
  };
  int tangents = 0;
  for (const Instruction& instruction : program.code) {
    switch (instruction.op) {
      case Op::tanh:
        if (degrees[static_cast<std::size_t>(instruction.operands[0])] > 0) ++tangents;
        [[fallthrough]];
      case Op::exp:
        if (turns_alone(instruction.operands[0])) return true;
        break;
      case Op::divide:
      case Op::elementwise_quotient:
        if (turns_alone(instruction.operands[1])) return true;
        break;
      default:
        break;
    }
  }
  return tangents > 1;
}

}  // namespace gainsmith::hybrid
