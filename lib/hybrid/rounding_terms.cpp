#include "hybrid/rounding_terms.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace gainsmith::hybrid {

namespace {

using expr::Instruction;
using expr::Op;
using expr::Program;

bool only_arranges(Op op) {
  switch (op) {
    case Op::input:
    case Op::constant:
    case Op::zeros:
    case Op::fill:
    case Op::identity:
    case Op::negate:
    case Op::transpose:
    case Op::blocks:
    case Op::index:
    case Op::abs:
    case Op::sign:
    case Op::floor:
    case Op::minimum:
    case Op::maximum:
    case Op::diagonal_matrix:
    case Op::diagonal_of:
      return true;
    default:
      return false;
  }
}

/// Whether all that the result is made of only arranges values; what a `where` asks does not count.
bool only_arranges(const Program& program, int at) {
  const Instruction& here = program.code[static_cast<std::size_t>(at)];
  const std::size_t skipped = here.op == Op::where ? 1 : 0;
  if (skipped == 0 && !only_arranges(here.op)) return false;
  return std::all_of(here.operands.begin() + static_cast<std::ptrdiff_t>(skipped),
                     here.operands.end(), [&](int one) { return only_arranges(program, one); });
}

class Terms {
 public:
  explicit Terms(Program& program) : program_(program), known_(program.code.size(), -1) {}

  int of(int at) {
    const auto k = static_cast<std::size_t>(at);
    if (known_[k] < 0) known_[k] = make(at);
    return known_[k];
  }

  /// Those of what is computed: 0 where the result is a value as it is, as that of clip(u, -m, m)
  /// at its ends.
  int computed(int at) {
    const Instruction here = program_.code[static_cast<std::size_t>(at)];
    const std::vector<int>& operands = here.operands;
    if (only_arranges(program_, at)) return made(Op::zeros, {}, here);
    switch (here.op) {
      case Op::minimum:
        return chosen(at, computed(operands[1]), computed(operands[0]));
      case Op::maximum:
        return chosen(at, computed(operands[0]), computed(operands[1]));
      case Op::where:
        return made(Op::where, {operands[0], computed(operands[1]), computed(operands[2])}, here);
      case Op::negate:
      case Op::abs:
        return computed(operands[0]);
      case Op::transpose:
      case Op::blocks:
      case Op::index:
      case Op::fill:
      case Op::diagonal_matrix:
      case Op::diagonal_of: {
        std::vector<int> parts;
        for (const int one : operands) parts.push_back(computed(one));
        return made(here.op, std::move(parts), here);
      }
      default:
        return of(at);
    }
  }

 private:
  /// `larger` where the first operand of a minimum or maximum is the larger one.
  int chosen(int at, int larger, int smaller) {
    Instruction here = program_.code[static_cast<std::size_t>(at)];
    const int difference = made(Op::subtract, {here.operands[0], here.operands[1]}, here);
    here.attributes = {1};
    return made(Op::where, {difference, larger, smaller}, here);
  }

  int make(int at) {
    const Instruction here = program_.code[static_cast<std::size_t>(at)];
    const std::vector<int>& operands = here.operands;
    switch (here.op) {
      case Op::add:
      case Op::subtract:
        return made(Op::add, all(operands), here);
      case Op::minimum:
      case Op::maximum:
        return made(Op::maximum, all(operands), here);
      case Op::where:
        return made(Op::maximum, {of(operands[1]), of(operands[2])}, here);
      case Op::divide:
      case Op::elementwise_quotient:
        return made(here.op, {of(operands[0]), absolute(operands[1])}, here);
      case Op::negate:
        return of(operands[0]);
      case Op::multiply:
      case Op::scale:
      case Op::elementwise_product:
      case Op::power:
      case Op::elementwise_power:
      case Op::transpose:
      case Op::blocks:
      case Op::index:
      case Op::fill:
      case Op::diagonal_matrix:
      case Op::diagonal_of:
      case Op::trace:
        return made(here.op, all(operands), here);
      default:
        return absolute(at);
    }
  }

  std::vector<int> all(const std::vector<int>& operands) {
    std::vector<int> result;
    for (const int one : operands) result.push_back(of(one));
    return result;
  }

  int absolute(int at) { return made(Op::abs, {at}, program_.code[static_cast<std::size_t>(at)]); }

  int made(Op op, std::vector<int> operands, Instruction like) {
    like.op = op;
    like.operands = std::move(operands);
    program_.code.push_back(std::move(like));
    return static_cast<int>(program_.code.size()) - 1;
  }

  Program& program_;
  std::vector<int> known_;
};

}  // namespace

std::optional<Program> rounding_terms(const Program& program) {
  if (only_arranges(program, program.result)) return std::nullopt;
  Program result = program;
  result.result = Terms(result).computed(program.result);
  return result;
}

}  // namespace gainsmith::hybrid
