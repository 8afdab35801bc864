#include "numbers/types/degree.h"

#include <algorithm>

namespace gainsmith::numbers {

namespace {

using expr::Instruction;
using expr::Is;
using expr::Op;
using At = expr::Step<Degree>;

Degree largest(expr::Operands<Degree> operands) {
  Degree result = 0;
  for (const Degree* operand : operands) result = std::max(result, *operand);
  return result;
}

/// The degree of an operation of which at least one operand moves: degrees 0, 1 and kNotAffine.
///   linear in all operands   the largest degree        a product   the sum of degrees
///   a/b                      that of a for constant b  a^1         that of a
///   where(d, a, b)           the largest degree, for constant d
/// All others, a jacobian apart, are not affine.
struct DegreeRules {
  template <Op op>
  requires expr::OneOf<op, Op::fill, Op::identity, Op::add, Op::subtract, Op::negate, Op::transpose,
                       Op::blocks, Op::index, Op::trace, Op::diagonal_matrix, Op::diagonal_of>
  void operator()(Is<op>, const At& at, Degree& out) const { out = largest(at.operands); }
  template <Op op>
  requires expr::OneOf<op, Op::multiply, Op::scale, Op::elementwise_product>
  void operator()(Is<op>, const At& at, Degree& out) const {
    out = std::min(kNotAffine, at[0] + at[1]);
  }
  template <Op op>
  requires expr::OneOf<op, Op::divide, Op::elementwise_quotient>
  void operator()(Is<op>, const At& at, Degree& out) const {
    out = at[1] == 0 ? at[0] : kNotAffine;
  }
  template <Op op>
  requires expr::OneOf<op, Op::power, Op::elementwise_power>
  void operator()(Is<op>, const At& at, Degree& out) const {
    out = at.attribute(0) == 1 ? at[0] : kNotAffine;
  }
  /// The derivative of what is affine in all that moves is constant.
  void operator()(Is<Op::jacobian>, const At& at, Degree& out) const {
    const expr::Program& body = *at.instruction.body;
    const auto all = degrees(body, [&](const std::string& name) {
      const auto input = static_cast<std::size_t>(body.input(name));
      return input == 0 || at[input] > 0;
    });
    out = all[static_cast<std::size_t>(body.result)] == kNotAffine ? kNotAffine : 0;
  }
  void operator()(Is<Op::where>, const At& at, Degree& out) const {
    out = at[0] == 0 ? largest(at.operands) : kNotAffine;
  }
  template <Op op>
  requires(expr::is_function(op) || expr::is_one_of(op, {Op::constant, Op::zeros})) void operator()(
      Is<op>, const At&, Degree& out) const {
    out = kNotAffine;
  }
};

}  // namespace

void DegreeAlgebra::apply(const Instruction& instruction, expr::Operands<Degree> operands,
                          Degree& out) const {
  out = 0;
  if (largest(operands) > 0) expr::dispatch(DegreeRules{}, instruction, operands, out);
}

std::vector<Degree> degrees(const expr::Program& program,
                            const std::function<bool(const std::string&)>& moves) {
  std::vector<Degree> result(program.code.size());
  std::vector<const Degree*> operands;
  for (std::size_t at = 0; at < program.code.size(); ++at) {
    const Instruction& instruction = program.code[at];
    operands.clear();
    for (const int operand : instruction.operands)
      operands.push_back(&result[static_cast<std::size_t>(operand)]);
    if (instruction.op == Op::input) {
      const auto input = static_cast<std::size_t>(instruction.attributes[0]);
      result[at] = moves(program.inputs[input].name) ? 1 : 0;
    } else if (instruction.op == Op::call) {
      result[at] = *operands[0] == 0 ? 0 : kNotAffine;
    } else {
      DegreeAlgebra{}.apply(instruction, operands, result[at]);
    }
  }
  return result;
}

}  // namespace gainsmith::numbers
