#include "hybrid/switches.h"

#include <algorithm>
#include <utility>

#include "expr/assembly.h"

namespace gainsmith::hybrid {

namespace {

using expr::Instruction;
using expr::Op;

class BranchHolder {
 public:
  BranchHolder(const expr::Program& program, const std::function<bool(const std::string&)>& moves,
               std::vector<Switch>& switches)
      : program_(program), moves_(moves), switches_(switches) {}

  expr::Program rewritten() {
    for (const Instruction& instruction : program_.code) add(instruction);
    return assembly_.extract(at_[static_cast<std::size_t>(program_.result)]);
  }

 private:
  void add(const Instruction& instruction) {
    if (instruction.op == Op::input) {
      const expr::Input& input =
          program_.inputs[static_cast<std::size_t>(instruction.attributes[0])];
      push(assembly_.add_input(input.name, input.shape, instruction), moves_(input.name));
      return;
    }
    Instruction copy = instruction;
    bool moving = false;
    for (int& operand : copy.operands) {
      const auto old = static_cast<std::size_t>(operand);
      moving = moving || moving_[old];
      operand = at_[old];
    }
    const bool branches = copy.op == Op::where || copy.op == Op::sign;
    if (!branches || !moving_[static_cast<std::size_t>(instruction.operands[0])]) {
      push(assembly_.add(std::move(copy)), moving);
      return;
    }
    const int held = assembly_.add_input(input_of(copy), assembly_.shape(copy.operands[0]), copy);
    if (copy.op == Op::sign) {
      push(held, false);
      return;
    }
    copy.operands[0] = held;
    copy.attributes = {1};
    push(assembly_.add(std::move(copy)), moving);
  }

  void push(int at, bool moving) {
    at_.push_back(at);
    moving_.push_back(moving);
  }

  std::string input_of(const Instruction& branch) {
    Switch one;
    one.difference = assembly_.extract(branch.operands[0]);
    one.is_sign = branch.op == Op::sign;
    one.strict = one.is_sign || branch.attributes[0] != 0;
    one.place = branch.place();
    const auto known = std::find_if(switches_.begin(), switches_.end(), [&](const Switch& other) {
      return other.is_sign == one.is_sign && other.strict == one.strict &&
             is_same(other.difference, one.difference);
    });
    if (known != switches_.end()) return known->input;
    one.input = "branch " + std::to_string(switches_.size() + 1);
    switches_.push_back(one);
    return one.input;
  }

  const expr::Program& program_;
  const std::function<bool(const std::string&)>& moves_;
  std::vector<Switch>& switches_;
  expr::Assembly assembly_;
  std::vector<int> at_;       ///< where each instruction of the program stands now
  std::vector<bool> moving_;  ///< and whether it depends on what moves
};

}  // namespace

expr::Program hold_branches(const expr::Program& program,
                            const std::function<bool(const std::string&)>& moves,
                            std::vector<Switch>& switches) {
  return BranchHolder(program, moves, switches).rewritten();
}

}  // namespace gainsmith::hybrid
