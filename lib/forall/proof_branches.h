// Internal to forall: an inequality whose formula jumps between branches, for proof_rules.h.
#pragma once

#include <cstddef>
#include <deque>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "expr/program/assembly.h"
#include "forall/proof_function.h"
#include "numbers/types/ball_functions.h"

namespace gainsmith::forall::proof {

/// The operations where(c, a, b) on numbers in a program. At each point B is that with one branch
/// of each. So where a piece meets both branches, B > 0 follows from B > 0 over the whole piece
/// with either of them: these have the derivatives that B lacks there.
template <class S>
class Branches {
 public:
  Branches(const expr::Program& program, numbers::EnclosedValues<S> known, bool strict,
           const std::vector<const Variable*>& axes)
      : program_(program), known_(std::move(known)), strict_(strict), axes_(axes) {
    for (std::size_t at = 0; at < program.code.size(); ++at) {
      const expr::Instruction& instruction = program.code[at];
      if (instruction.op != expr::Op::where || !instruction.shape.is_scalar()) continue;
      const expr::Program& condition = programs_.emplace_back(part(instruction.operands[0], {}));
      conditions_.push_back({static_cast<int>(at), instruction.attributes[0] != 0,
                             std::make_unique<Function<S>>(condition, known_, strict, axes)});
    }
  }

  /// B with each choice of the branches that a piece meets; empty where it meets none or too many.
  std::vector<Function<S>*> over(const Piece& piece) {
    // Operations `where`: at most 16 choices.
    constexpr std::size_t kMost = 4;
    std::vector<int> met;
    for (Condition& condition : conditions_) {
      const Enclosed<double> value = condition.function->value_over(piece);
      if (value.is_known() && !numbers::ball::holds(value.ball(0), condition.strict))
        met.push_back(condition.at);
    }
    std::vector<Function<S>*> result;
    if (met.empty() || met.size() > kMost) return result;
    for (std::size_t choice = 0; choice < (std::size_t{1} << met.size()); ++choice) {
      std::map<int, std::size_t> branch;
      for (std::size_t i = 0; i < met.size(); ++i) branch[met[i]] = 1 + ((choice >> i) & 1U);
      auto& function = functions_[branch];
      if (!function)
        function = std::make_unique<Function<S>>(
            programs_.emplace_back(part(program_.result, branch)), known_, strict_, axes_);
      result.push_back(function.get());
    }
    return result;
  }

 private:
  struct Condition {
    int at;  ///< in the code
    bool strict;
    std::unique_ptr<Function<S>> function;
  };

  /// What an instruction needs and no more, each `where` of `branch` replaced by that operand.
  expr::Program part(int result, const std::map<int, std::size_t>& branch) const {
    expr::Assembly assembly;
    const auto replace = [&](const expr::Instruction& instruction,
                             const expr::Instruction& copy) -> std::optional<int> {
      const auto found = branch.find(static_cast<int>(&instruction - program_.code.data()));
      if (found == branch.end()) return std::nullopt;
      return copy.operands[found->second];
    };
    return assembly.extract(assembly.add_all(program_, replace)[static_cast<std::size_t>(result)]);
  }

  const expr::Program& program_;
  numbers::EnclosedValues<S> known_;
  bool strict_;
  const std::vector<const Variable*>& axes_;
  std::deque<expr::Program> programs_;  ///< of the functions
  std::vector<Condition> conditions_;
  std::map<std::map<int, std::size_t>, std::unique_ptr<Function<S>>> functions_;
};

}  // namespace gainsmith::forall::proof
