#include "expr/program/number_type.h"

#include "base/number.h"

namespace gainsmith::expr::fault {

void singular(const Instruction& inverse) {
  throw EvaluationError((inverse.text.empty() ? "inv: the matrix" : inverse.text) +
                        " is singular to working precision");
}

void division_by_zero() { throw EvaluationError("division by zero"); }

/// A root of hardly less than 0, above -1e-9, is likely to be rounding: the message says what to
/// write.
void outside_domain(Op op, double value) {
  constexpr double kHardlyNegative = 1e-9;
  const bool is_hardly = op == Op::sqrt && value < 0 && value > -kHardlyNegative;
  throw EvaluationError(to_string(op) + " of " + brief(value) +
                        (is_hardly ? " (where that is rounding, write sqrt(max(..., 0)))" : ""));
}

void not_finite(Op op) {
  throw EvaluationError("the " + to_string(op) + " is not a finite number");
}

void without_result(Op op, const std::string& why) {
  throw EvaluationError(to_string(op) + ": " + why);
}

void no_error_bound(Op op) {
  throw EvaluationError("the " + to_string(op) +
                        " has no error bound, so nothing is proved with it");
}

/// Quotients, logarithms and roots may say more than the operation, as tan does at its pole.
std::string said_of(const Instruction& instruction, const std::string& found) {
  using enum Op;
  const bool says = is_one_of(instruction.op, {divide, elementwise_quotient, log, sqrt});
  return says && !instruction.text.empty() ? instruction.text : found;
}

void beyond_range(const Instruction& constant) {
  throw EvaluationError("the number " + constant.text + " is beyond the range of double");
}

}  // namespace gainsmith::expr::fault
