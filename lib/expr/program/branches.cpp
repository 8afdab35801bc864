#include "expr/program/branches.h"

#include <algorithm>
#include <utility>

#include "expr/program/assembly.h"

namespace gainsmith::expr {

namespace {

/// Collects what a program and the bodies in it branch on.
class BranchCollector {
 public:
  explicit BranchCollector(const std::function<bool(const std::string&)>& moves) : moves_(moves) {}

  /// Over the inputs of the program; differences that are equal are kept once.
  std::vector<Branch> take(const Program& program) {
    std::vector<int> inputs;
    for (const Input& input : program.inputs)
      inputs.push_back(assembly_.add_input(input.name, input.shape, program.code.front()));
    walk(program, inputs);
    return std::move(found_);
  }

 private:
  /// `inputs`: the instructions that are the inputs of the program.
  /// The bodies of jacobians are walked with the operands as their inputs. The derivative of what
  /// has a kink jumps there.
  void walk(const Program& program, const std::vector<int>& inputs) {
    std::vector<int> at;
    for (const Instruction& instruction : program.code) {
      if (instruction.op == Op::input) {
        at.push_back(inputs[static_cast<std::size_t>(instruction.attributes[0])]);
        continue;
      }
      Instruction moved = instruction;
      for (int& operand : moved.operands) operand = at[static_cast<std::size_t>(operand)];
      note(moved);
      if (moved.op == Op::jacobian) {
        ++derivatives_;
        walk(*moved.body, moved.operands);
        --derivatives_;
      }
      at.push_back(assembly_.add(std::move(moved)));
    }
  }

  /// The difference of one instruction, if it branches.
  void note(const Instruction& branch) {
    const std::vector<int>& operands = branch.operands;
    switch (branch.op) {
      case Op::where:
      case Op::sign:
        return keep(operands[0], true);
      // It jumps where y changes its sign at an x < 0.
      case Op::atan2:
        if (is_not_negative(operands[0]) || is_not_negative(operands[1])) return;
        return keep(operands[0], true);
      case Op::floor:
        return keep(whole(operands[0], branch), true, true);
      case Op::mod:
        return keep(whole(made(Op::elementwise_quotient, operands, branch), branch), true, true);
      case Op::maximum:
      case Op::minimum:
        return keep(made(Op::subtract, operands, branch), false);
      case Op::abs:
        return keep(operands[0], false);
      case Op::norm:
        if (assembly_.shape(operands[0]).is_scalar()) keep(operands[0], false);
        return;
      default:
        return;
    }
  }

  /// Whether the text of a value says so: asin, acos and atan are made of such angles.
  bool is_not_negative(int at) const {
    const Instruction& instruction = assembly_[at];
    // A constant of the language has no sign.
    if (instruction.op == Op::constant) return !instruction.text.starts_with('-');
    if (instruction.op == Op::fill) return is_not_negative(instruction.operands[0]);
    return is_one_of(instruction.op, {Op::sqrt, Op::abs, Op::exp, Op::norm});
  }

  int made(Op op, std::vector<int> operands, const Instruction& like) {
    const Shape shape = assembly_.shape(operands.back());
    return assembly_.add({op, std::move(operands), shape, {}, {}, like.origin, like.offset});
  }

  /// 0 where the operand is a whole number.
  int whole(int operand, const Instruction& like) {
    const int pi = assembly_.add({Op::constant, {}, {1, 1}, {}, "pi", like.origin, like.offset});
    return made(Op::sin, {made(Op::scale, {pi, operand}, like)}, like);
  }

  /// The derivative of what has a kink jumps.
  void keep(int difference, bool jumps, bool waves = false) {
    jumps = jumps || derivatives_ > 0;
    Branch branch{assembly_.extract(difference), jumps, waves};
    const auto& inputs = branch.difference.inputs;
    if (std::none_of(inputs.begin(), inputs.end(),
                     [&](const Input& input) { return moves_(input.name); }))
      return;
    for (Branch& known : found_)
      if (is_same(known.difference, branch.difference)) {
        known.jumps = known.jumps || jumps;
        return;
      }
    found_.push_back(std::move(branch));
  }

  const std::function<bool(const std::string&)>& moves_;
  Assembly assembly_;
  std::vector<Branch> found_;
  int derivatives_ = 0;  ///< that are taken of the program at hand
};

}  // namespace

std::vector<Branch> branches_of(const Program& program,
                                const std::function<bool(const std::string&)>& moves) {
  return BranchCollector(moves).take(program);
}

}  // namespace gainsmith::expr
