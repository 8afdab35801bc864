#include "hybrid/rounding_terms.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace gainsmith::hybrid {

namespace {

using expr::Instruction;
using expr::Op;
using expr::Program;

/// Whether all that the result is made of only arranges values; what a `where` asks does not count.
bool only_arranges(const Program& program, int at) {
  using enum Op;
  const Instruction& here = program.code[static_cast<std::size_t>(at)];
  const std::size_t skipped = here.op == where ? 1 : 0;
  if (skipped == 0 &&
      !is_one_of(here.op, {input, constant, zeros, fill, identity, negate, transpose, blocks, index,
                           abs, sign, floor, minimum, maximum, diagonal_matrix, diagonal_of}))
    return false;
  return std::all_of(here.operands.begin() + static_cast<std::ptrdiff_t>(skipped),
                     here.operands.end(), [&](int one) { return only_arranges(program, one); });
}

/// Appends to a program the instructions of the sizes of its terms. With [v] for those of v:
///
///   [a + b] = [a - b] = [a] + [b]     [-a] = [a]     [a/b] = [a]/|b|     [A B] = [A] [B]
///   [v] = |v| where v is one term
///
/// What counts as one term depends on `Of`: rounding, value or sign (rounding_terms.h).
class Terms {
  using enum Op;

 public:
  enum class Of { rounding, value, sign };

  Terms(Program& program, Of of) : program_(program), of_(of), known_(program.code.size(), -1) {}

  /// The index of the instruction that computes [v] of instruction `at`; each is made once.
  int of(int at) {
    const auto k = static_cast<std::size_t>(at);
    if (known_[k] < 0) known_[k] = make(at);
    return known_[k];
  }

  /// Those of what is computed: 0 where the result is a value as it is, as that of clip(u, -m, m)
  /// at its ends.
  int computed(int at) {
    const Instruction here = instruction(at);
    const std::vector<int>& operands = here.operands;
    if (only_arranges(program_, at)) return made(zeros, {}, here);
    if (here.op == minimum) return chosen(at, computed(operands[1]), computed(operands[0]));
    if (here.op == maximum) return chosen(at, computed(operands[0]), computed(operands[1]));
    if (here.op == where)
      return made(where, {operands[0], computed(operands[1]), computed(operands[2])}, here);
    if (is_one_of(here.op, {negate, abs})) return computed(operands[0]);
    if (!is_one_of(here.op, {transpose, blocks, index, fill, diagonal_matrix, diagonal_of}))
      return of(at);
    std::vector<int> parts;
    for (const int one : operands) parts.push_back(computed(one));
    return made(here.op, std::move(parts), here);
  }

 private:
  const Instruction& instruction(int at) const {
    return program_.code[static_cast<std::size_t>(at)];
  }

  /// `larger` where the first operand of a minimum or maximum is the larger one.
  int chosen(int at, int larger, int smaller) {
    Instruction here = instruction(at);
    const int difference = made(subtract, {here.operands[0], here.operands[1]}, here);
    here.attributes = {1};
    return made(where, {difference, larger, smaller}, here);
  }

  /// The rules above, by operation.
  int make(int at) {
    const Instruction here = instruction(at);
    const std::vector<int>& operands = here.operands;
    switch (here.op) {
      case negate:
        return of(operands[0]);
      case add:
      case subtract:
        return made(add, all(operands), here);
      case scale:
      case elementwise_product:
        return made(here.op, all(operands), here);
      case divide:
        return made(divide, {of(operands[0]), absolute(operands[1])}, here);
      case multiply:
        if (of_ == Of::rounding || is_product_of_numbers(here) ||
            has_sum(operands[0]) != has_sum(operands[1]))
          return made(multiply, all(operands), here);
        break;
      case index:
      case transpose:
      case blocks:
        if (of_ == Of::rounding || has_sum(at)) return made(here.op, all(operands), here);
        break;
      case abs:
      case sin:
      case tanh:  // they round as their arguments do
        if (of_ == Of::sign) return of(operands[0]);
        break;
      case atan2:  // by (|dy| + |dx|)/(|y| + |x|), but for a factor
        if (of_ != Of::sign || !here.shape.is_scalar()) break;
        return made(
            divide,
            {made(add, all(operands), here),
             made(add, {made(abs, {operands[0]}, here), made(abs, {operands[1]}, here)}, here)},
            here);
      default:
        if (of_ == Of::rounding) return of_other(at);
    }
    return absolute(at);
  }

  /// Of what is a term where values and signs are asked for.
  int of_other(int at) {
    const Instruction here = instruction(at);
    const std::vector<int>& operands = here.operands;
    if (is_one_of(here.op, {minimum, maximum})) return made(maximum, all(operands), here);
    if (here.op == where) return made(maximum, {of(operands[1]), of(operands[2])}, here);
    if (here.op == elementwise_quotient)
      return made(here.op, {of(operands[0]), absolute(operands[1])}, here);
    if (is_one_of(here.op, {power, elementwise_power, fill, diagonal_matrix, diagonal_of, trace}))
      return made(here.op, all(operands), here);
    return absolute(at);
  }

  std::vector<int> all(const std::vector<int>& operands) {
    std::vector<int> result;
    for (const int one : operands) result.push_back(of(one));
    return result;
  }

  /// An abs of what is never negative would be one more branch.
  int absolute(int at) {
    return is_never_negative(at) ? at : made(abs, {at}, Instruction(instruction(at)));
  }
  bool is_never_negative(int at) const {
    const Instruction& here = instruction(at);
    if (here.op == index) return is_never_negative(here.operands[0]);
    return is_one_of(here.op, {abs, exp, norm, singular_values, sqrt});
  }
  bool is_product_of_numbers(const Instruction& product) const {
    return std::ranges::all_of(product.operands,
                               [&](int one) { return instruction(one).shape.is_scalar(); });
  }
  /// Whether its elements are sums whose terms may cancel.
  bool has_sum(int at) const {
    const Instruction& here = instruction(at);
    if (is_one_of(here.op, {add, subtract})) return true;
    return is_one_of(here.op, {negate, scale, divide, multiply, index, transpose, blocks}) &&
           std::ranges::any_of(here.operands, [&](int operand) { return has_sum(operand); });
  }

  int made(Op op, std::vector<int> operands, Instruction like) {
    if (op == abs) like = expr::made(abs, {}, instruction(operands[0]).shape, like);
    like.op = op;
    like.operands = std::move(operands);
    program_.code.push_back(std::move(like));
    return static_cast<int>(program_.code.size()) - 1;
  }

  Program& program_;
  Of of_;
  std::vector<int> known_;
};

}  // namespace

std::optional<Program> rounding_terms(const Program& program) {
  if (only_arranges(program, program.result)) return std::nullopt;
  Program result = program;
  result.result = Terms(result, Terms::Of::rounding).computed(program.result);
  return result;
}

Program absolute_terms(Program program) {
  program.result = Terms(program, Terms::Of::value).of(program.result);
  return program;
}

Program terms_of_sign(Program program) {
  program.result = Terms(program, Terms::Of::sign).of(program.result);
  return program;
}

}  // namespace gainsmith::hybrid
