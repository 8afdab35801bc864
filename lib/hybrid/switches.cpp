#include "hybrid/switches.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "expr/program/assembly.h"

namespace gainsmith::hybrid {

namespace {

using expr::Instruction;
using expr::Op;
using expr::Program;
using expr::Shape;

std::optional<Switch::Kind> kind_of(const Instruction& instruction, Shape operand) {
  switch (instruction.op) {
    case Op::where:
      return Switch::Kind::where;
    case Op::sign:
      return Switch::Kind::sign;
    case Op::abs:
    case Op::maximum:
    case Op::minimum:
      return Switch::Kind::kink;
    case Op::norm:
      if (operand.is_scalar()) return Switch::Kind::kink;
      return std::nullopt;
    default:
      return std::nullopt;
  }
}

/// What a branching instruction becomes once `fixed`, the instruction of its H, says which
/// branch is taken. None: H itself.
std::optional<Instruction> fixed_form(const Instruction& branch, int fixed) {
  switch (branch.op) {
    case Op::where:
    case Op::maximum:
    case Op::minimum: {
      const bool where = branch.op == Op::where;
      int a = branch.operands[where ? 1 : 0];
      int b = branch.operands[where ? 2 : 1];
      if (branch.op == Op::minimum) std::swap(a, b);
      return made(Op::where, {fixed, a, b}, branch.shape, branch, {1});
    }
    case Op::abs:
    case Op::norm:
      return made(Op::elementwise_product, {branch.operands[0], fixed}, branch.shape, branch);
    default:
      return std::nullopt;
  }
}

/// A program in which instructions are replaced one by one, with all that it had: its first inputs
/// keep their places.
class Rewritten {
 public:
  explicit Rewritten(const Program& old) { made_.inputs = old.inputs; }

  int operator[](int old) const { return at_[static_cast<std::size_t>(old)]; }
  int push(Instruction instruction) {
    made_.code.push_back(std::move(instruction));
    return static_cast<int>(made_.code.size()) - 1;
  }
  int push_input(const std::string& name, Shape shape, const Instruction& like) {
    const int known = made_.input(name);
    const int at = known >= 0 ? known : static_cast<int>(made_.inputs.size());
    if (known < 0) made_.inputs.push_back({name, shape});
    return push(made(Op::input, {}, shape, like, {at}));
  }
  std::size_t inputs() const { return made_.inputs.size(); }
  /// Where the next instruction of the old program is now.
  void set_next(int at) { at_.push_back(at); }
  Instruction moved(const Instruction& instruction) const { return expr::moved(instruction, at_); }
  Program take(int old_result) {
    made_.result = (*this)[old_result];
    return std::move(made_);
  }

 private:
  Program made_;
  std::vector<int> at_;
};

/// Copies a program instruction by instruction into an assembly and replaces each branch on what
/// moves. A branch on constants stays as it is.
class BranchFixer {
 public:
  BranchFixer(const std::function<bool(const std::string&)>& moves, std::vector<Switch>& switches)
      : moves_(moves), switches_(switches) {}

  Program rewritten(const Program& program) {
    const auto replace = [&](const Instruction& instruction, const Instruction& copy) {
      if (instruction.op != Op::input) return std::optional(add(copy));
      const expr::Input& input = program.input_of(instruction);
      return std::optional(
          note(assembly_.add_input(input.name, input.shape, instruction), moves_(input.name)));
    };
    return assembly_.extract(assembly_.add_program(program, replace));
  }

 private:
  bool moves(const Instruction& instruction) const {
    return std::any_of(instruction.operands.begin(), instruction.operands.end(),
                       [&](int operand) { return moving_[static_cast<std::size_t>(operand)]; });
  }

  int note(int at, bool moving) {
    if (static_cast<std::size_t>(at) >= moving_.size())
      moving_.resize(static_cast<std::size_t>(at) + 1, false);
    moving_[static_cast<std::size_t>(at)] = moving;
    return at;
  }

  /// Adds an instruction with operands of the assembly, fixed where it branches.
  int add(Instruction instruction) {
    const bool moving = moves(instruction);
    if (const std::string name = input_of(instruction); !name.empty()) {
      const int fixed = add_fixed(name, instruction);
      const auto form = fixed_form(instruction, fixed);
      return form ? note(assembly_.add(*form), moves(*form)) : fixed;
    }
    if (instruction.op == Op::jacobian && moving) fix_body(instruction);
    return note(assembly_.add(std::move(instruction)), moving);
  }

  /// Of the H of a branching instruction.
  int add_fixed(const std::string& name, const Instruction& branch) {
    const auto found = std::ranges::find(switches_, name, &Switch::input);
    return note(assembly_.add_input(name, found->difference.shape(), branch), false);
  }

  /// Replaces the branches in the body of a jacobian, whose operands are in the assembly: each H is
  /// another operand. What a branch hangs on is computed outside, from the same operands.
  void fix_body(Instruction& jacobian) {
    const Program& body = *jacobian.body;
    Rewritten inner(body);
    std::vector<int> outside;
    const auto fixed_inside = [&](const std::string& name, const Instruction& like) {
      const int fixed = add_fixed(name, like);
      const std::size_t inputs = jacobian.operands.size();
      const int at = inner.push_input(name, assembly_.shape(fixed), like);
      if (inner.inputs() > inputs) jacobian.operands.push_back(fixed);
      return at;
    };
    for (const Instruction& instruction : body.code) {
      if (instruction.op == Op::input) {
        outside.push_back(jacobian.operands[static_cast<std::size_t>(instruction.attributes[0])]);
        inner.set_next(inner.push(instruction));
        continue;
      }
      Instruction here = inner.moved(instruction);
      Instruction there = expr::moved(instruction, outside);
      if (const std::string name = input_of(there); !name.empty()) {
        const int fixed = fixed_inside(name, instruction);
        const auto form = fixed_form(here, fixed);
        inner.set_next(form ? inner.push(*form) : fixed);
      } else if (instruction.op == Op::jacobian && moves(there)) {
        const std::size_t before = there.operands.size();
        fix_body(there);
        here.body = there.body;
        for (std::size_t k = before; k < there.operands.size(); ++k)
          here.operands.push_back(fixed_inside(there.body->inputs[k].name, instruction));
        inner.set_next(inner.push(std::move(here)));
      } else {
        inner.set_next(inner.push(std::move(here)));
      }
      outside.push_back(add(expr::moved(instruction, outside)));
    }
    jacobian.body = std::make_shared<const Program>(inner.take(body.result));
  }

  /// The name of the H of an instruction that branches on what moves, otherwise "".
  std::string input_of(const Instruction& branch) {
    if (branch.operands.empty()) return "";
    const auto kind = kind_of(branch, assembly_.shape(branch.operands[0]));
    if (!kind) return "";
    int difference = branch.operands[0];
    if (branch.op == Op::maximum || branch.op == Op::minimum) {
      if (!moves(branch)) return "";
      difference =
          note(assembly_.add(made(Op::subtract, branch.operands, branch.shape, branch)), true);
    }
    if (!moving_[static_cast<std::size_t>(difference)]) return "";
    Switch one;
    one.difference = assembly_.extract(difference);
    one.kind = *kind;
    one.strict = one.kind != Switch::Kind::where || branch.attributes[0] != 0;
    one.place = branch.place();
    const auto known = std::find_if(switches_.begin(), switches_.end(), [&](const Switch& other) {
      return other.kind == one.kind && other.strict == one.strict &&
             is_same(other.difference, one.difference);
    });
    if (known != switches_.end()) return known->input;
    one.input = "branch " + std::to_string(switches_.size() + 1);
    switches_.push_back(one);
    return one.input;
  }

  const std::function<bool(const std::string&)>& moves_;
  std::vector<Switch>& switches_;
  expr::Assembly assembly_;
  std::vector<bool> moving_;  ///< by instruction of the assembly: whether it depends on what moves
};

}  // namespace

expr::Program fix_branches(const expr::Program& program,
                           const std::function<bool(const std::string&)>& moves,
                           std::vector<Switch>& switches) {
  return BranchFixer(moves, switches).rewritten(program);
}

}  // namespace gainsmith::hybrid
