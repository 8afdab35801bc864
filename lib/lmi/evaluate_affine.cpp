// Affine forms of programs: what depends on data alone is computed in doubles, the rest as forms.
#include <stdexcept>
#include <utility>
#include <vector>

#include "lmi/affine_algebra.h"
#include "numbers/types/real.h"

namespace gainsmith::lmi {

namespace {

/// The value of one instruction: a matrix of doubles, or a form.
class Register {
 public:
  static Register reference(const numbers::Matrix& matrix) {
    Register result;
    result.matrix_ = &matrix;
    return result;
  }
  static Register own(AffineForm form) {
    Register result;
    result.form_ = std::move(form);
    result.has_form_ = true;
    return result;
  }

  bool is_number() const { return is_own_ || matrix_ != nullptr; }
  const numbers::Matrix& matrix() const { return is_own_ ? own_ : *matrix_; }
  numbers::Matrix& make_number() {
    is_own_ = true;
    return own_;
  }

  const AffineForm& form() {
    if (!has_form_) form_ = constant_form(matrix());
    has_form_ = true;
    return form_;
  }

 private:
  const numbers::Matrix* matrix_ = nullptr;
  numbers::Matrix own_;
  bool is_own_ = false;
  AffineForm form_;
  bool has_form_ = false;
};

/// One evaluation, instruction by instruction. An instruction whose operands are all numbers is
/// computed in doubles; the others are computed as forms.
class Run {
 public:
  Run(const expr::Program& program, const AffineAlgebra& algebra, const numbers::Values& values,
      const forall::Point* point)
      : program_(program), algebra_(algebra), values_(values), point_(point) {}

  AffineForm result() {
    registers_.resize(program_.code.size());
    for (std::size_t at = 0; at < program_.code.size(); ++at) {
      const expr::Instruction& instruction = program_.code[at];
      try {
        compute(instruction, registers_[at]);
      } catch (const expr::EvaluationError& error) {
        throw expr::EvaluationError(instruction.place(), error.message());
      }
    }
    return registers_[static_cast<std::size_t>(program_.result)].form();
  }

 private:
  void compute(const expr::Instruction& instruction, Register& out) {
    if (instruction.op == expr::Op::call)
      throw std::logic_error("a call of " + instruction.text + " that was not linked");
    if (instruction.op == expr::Op::input) {
      out = input(program_.input_of(instruction).name);
      return;
    }
    bool numbers = true;
    for (const int operand : instruction.operands)
      numbers &= registers_[static_cast<std::size_t>(operand)].is_number();
    if (numbers) {
      matrices_.clear();
      for (const int operand : instruction.operands)
        matrices_.push_back(&registers_[static_cast<std::size_t>(operand)].matrix());
      numbers::RealAlgebra().apply(instruction, matrices_, out.make_number());
      return;
    }
    forms_.clear();
    for (const int operand : instruction.operands)
      forms_.push_back(&registers_[static_cast<std::size_t>(operand)].form());
    AffineForm form;
    algebra_.apply(instruction, forms_, form);
    out = Register::own(std::move(form));
  }

  /// A variable that is symbolic, an unknown, a value of the point, or a datum: the first of these
  /// that has the name. std::out_of_range for no such name.
  Register input(const std::string& name) const {
    if (const int variable = algebra_.monomials->find_variable(name); variable >= 0)
      return Register::own(variable_form(*algebra_.monomials, variable));
    if (const Unknown* unknown = algebra_.unknowns->find(name))
      return Register::own(unknown_form(*unknown));
    if (point_ != nullptr)
      if (const auto chosen = point_->values.find(name); chosen != point_->values.end())
        return Register::reference(chosen->second);
    return Register::reference(values_.at(name));
  }

  const expr::Program& program_;
  const AffineAlgebra algebra_;
  const numbers::Values& values_;
  const forall::Point* point_;
  std::vector<Register> registers_;
  std::vector<const numbers::Matrix*> matrices_;
  std::vector<const AffineForm*> forms_;
};

}  // namespace

AffineForm evaluate_affine(const expr::Program& program, const Unknowns& unknowns,
                           forall::MonomialTable& monomials, const numbers::Values& values) {
  return Run(program, {&monomials, &unknowns}, values, nullptr).result();
}

AffineForm evaluate_at(const expr::Program& program, const Unknowns& unknowns,
                       forall::MonomialTable& monomials, const numbers::Values& values,
                       const forall::Point& point) {
  return Run(program, {&monomials, &unknowns}, values, &point).result();
}

}  // namespace gainsmith::lmi
