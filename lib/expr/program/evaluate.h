// Evaluation of a program over a number type (number_type.h).
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "expr/program/number_type.h"
#include "expr/program/program.h"

namespace gainsmith::expr {

/// Runs one program again and again. Inputs given by fix() keep their value, and what depends on
/// them alone is computed once; the others are given by set() before each run(). Values of inputs
/// are held by pointer and must outlive the run. The registers are kept, so that a run over a value
/// type that reuses its memory allocates nothing. An operation without a result is an
/// EvaluationError with its place; the evaluator can be used after it.
template <NumberType Type>
class Evaluator {
 public:
  using Value = typename Type::Value;

  /// `program` must outlive the evaluator.
  explicit Evaluator(const Program& program, Type type = {})
      : program_(&program),
        type_(std::move(type)),
        inputs_(program.inputs.size()),
        fixed_(program.inputs.size(), false),
        registers_(program.code.size()) {}

  Evaluator(Evaluator&&) noexcept = default;  // a copy's operands would point into the original
  Evaluator& operator=(Evaluator&&) noexcept = default;

  void fix(const std::string& name, const Value& value) {
    const int at = program_->input(name);
    if (at < 0) return;
    inputs_[static_cast<std::size_t>(at)] = &value;
    fixed_[static_cast<std::size_t>(at)] = true;
    prepared_ = false;
    linked_ = false;
  }

  void set(std::size_t input, const Value& value) {
    inputs_[input] = &value;
    linked_ = false;
  }

  /// Sets an input by name; a name that the program does not use is ignored.
  void set(const std::string& name, const Value& value) {
    const int at = program_->input(name);
    if (at >= 0) set(static_cast<std::size_t>(at), value);
  }

  /// Computes what depends on fixed inputs alone, which run() does otherwise. All inputs must be
  /// set.
  void prepare() {
    check();
    link();
    std::vector<bool> moves(program_->code.size());
    varying_.clear();
    for (std::size_t at = 0; at < program_->code.size(); ++at) {
      const Instruction& instruction = program_->code[at];
      if (instruction.op == Op::input) {
        moves[at] = !fixed_[static_cast<std::size_t>(instruction.attributes[0])];
        continue;
      }
      for (const int operand : instruction.operands)
        if (moves[static_cast<std::size_t>(operand)]) moves[at] = true;
      if (moves[at]) {
        varying_.push_back(at);
      } else {
        compute(at);
      }
    }
    prepared_ = true;
  }

  /// The result; valid until the next run.
  const Value& run() {
    if (!prepared_) prepare();
    if (!linked_) link();
    for (const std::size_t at : varying_) compute(at);
    return value(static_cast<std::size_t>(program_->result));
  }

 private:
  const Value& value(std::size_t at) const {
    const Instruction& instruction = program_->code[at];
    if (instruction.op != Op::input) return registers_[at];
    return *inputs_[static_cast<std::size_t>(instruction.attributes[0])];
  }

  void compute(std::size_t at) {
    const Instruction& instruction = program_->code[at];
    try {
      type_.apply(instruction, {operands_.data() + first_operand_[at], instruction.operands.size()},
                  registers_[at]);
    } catch (const EvaluationError& error) {
      throw EvaluationError(instruction.place(), fault::said_of(instruction, error.message()));
    }
  }

  /// Finds where the operands of all instructions are.
  void link() {
    operands_.clear();
    first_operand_.clear();
    for (const Instruction& instruction : program_->code) {
      first_operand_.push_back(operands_.size());
      for (const int operand : instruction.operands)
        operands_.push_back(&value(static_cast<std::size_t>(operand)));
    }
    linked_ = true;
  }

  /// std::logic_error when something has no value that the caller must give.
  void check() const {
    for (const Instruction& instruction : program_->code)
      if (instruction.op == Op::call)
        throw std::logic_error("a call of " + instruction.text + " that was not linked");
    for (std::size_t i = 0; i < inputs_.size(); ++i)
      if (inputs_[i] == nullptr)
        throw std::logic_error("no value for the input " + program_->inputs[i].name);
  }

  const Program* program_;
  Type type_;
  std::vector<const Value*> inputs_;
  std::vector<bool> fixed_;
  std::vector<Value> registers_;
  std::vector<const Value*> operands_;  ///< of all instructions, one after the other
  std::vector<std::size_t> first_operand_;
  /// The instructions that run() computes, in order.
  std::vector<std::size_t> varying_;
  /// What depends on fixed inputs alone is computed.
  bool prepared_ = false;
  /// operands_ are those of the inputs that are set.
  bool linked_ = false;
};

}  // namespace gainsmith::expr
