// The contract of a number type: what expressions are evaluated over.
//
// A number type gives each operation of operations.def a meaning for its values, which are matrices
// of numbers: doubles, numbers of 100 digits, many points at once, affine forms in unknowns, balls.
//
//   struct Type {
//     using Value = ...;
//     // Computes one instruction from the values of its operands into `out`, which may hold an old
//     // value of the same shape; no operand is `out`.
//     void apply(const Instruction&, Operands<Value>, Value& out) const;
//   };
//
// apply() is one call of dispatch() below, over rules with one overload for each operation:
//
//   struct Rules {
//     void operator()(Is<Op::add>, const Step<Value>& step, Value& out) const;
//     ...
//   };
//
// Rules that forget an operation do not compile, and the message names it. Several operations may
// share one overload, but only by being listed (OneOf), so that a new operation asks to be thought
// of in every number type.
//
// What holds for each of them, and is tested for each by tests/numbers/conformance.h:
//  1. A value that does not move (see 4) is that of Real (numbers/types/real.h), to the type's
//     precision. A decimal becomes a number once, rounded by the type from its text.
//  2. Shapes are as the instruction says. Values depend on operands alone: the same operands, the
//     same bits.
//  3. An operation without a result throws EvaluationError with the texts of `fault`. The evaluator
//     adds the place. No other exception signals a fault of the values.
//  4. A value moves when it represents many at once: the points of a pack, the unknowns of an
//     affine form, the degree above 0. An operation that a type does not have for moving operands
//     throws EvaluationError too, and the type lists it. In a pack a point without a result is not
//     a number and the other points go on.
//  5. Empty matrices are values like others.
//  6. Projections (project_...) and flow_map are computed by Real and what goes back to it. A type
//     that bounds errors may lack them: it throws fault::no_error_bound, whatever moves. So does
//     Op::extremum: what is found is a value at a point, and where the true one lies is not known.
//  7. The operands of Op::jacobian are the inputs of its body, which the type differentiates by the
//     first of them; Dual (numbers/types/dual.h) does so over the reals.
#pragma once

#include <concepts>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>

#include "base/error.h"
#include "expr/program/program.h"

namespace gainsmith::expr {

/// An operation has no result: a singular inverse, the logarithm of a negative number, a product of
/// two unknowns. A number type throws it without a place; what leaves an evaluator has the place of
/// the instruction, whatever the number type.
class EvaluationError : public InputError {
 public:
  explicit EvaluationError(const std::string& message) : InputError({}, message) {}
  EvaluationError(const Place& place, const std::string& message) : InputError(place, message) {}
};

/// The faults that number types have in common, in the words that a person reads.
namespace fault {

/// inverse: the instruction, whose text may say of what.
[[noreturn]] void singular(const Instruction& inverse);
[[noreturn]] void division_by_zero();
/// "log of -0.1".
[[noreturn]] void outside_domain(Op op, double value);
[[noreturn]] void not_finite(Op op);
/// "project_polytope: the polytope is empty".
[[noreturn]] void without_result(Op op, const std::string& why);
/// Of an operation that a number type with error bounds does not have.
[[noreturn]] void no_error_bound(Op op);
/// What is said of an instruction without a result: its own text, where a function that is made of
/// operations gave it one, and what the operation says otherwise.
std::string said_of(const Instruction& instruction, const std::string& found);
/// The decimal is finite, but not in double.
[[noreturn]] void beyond_range(const Instruction& constant);

}  // namespace fault

template <class Value>
using Operands = std::span<const Value* const>;

/// One instruction with the values of its operands.
/// It lives as long as the call of one rule; instruction and operands are those of the evaluator.
template <class Value>
struct Step {
  const Instruction& instruction;
  Operands<Value> operands;

  const Value& operator[](std::size_t i) const { return *operands[i]; }
  Shape shape() const { return instruction.shape; }
  int attribute(std::size_t i) const { return instruction.attributes[i]; }
};

/// Names an operation in overloads.
template <Op op>
struct Is {
  static constexpr Op value = op;
};

/// `op` is in the list: template <Op op> requires OneOf<op, Op::sin, Op::cos> void f(Is<op>).
template <Op op, Op... list>
concept OneOf = ((op == list) || ...);

template <class Type>
concept NumberType = std::default_initializable<typename Type::Value> &&
    requires(const Type& type, const Instruction& instruction,
             Operands<typename Type::Value> operands, typename Type::Value& out) {
  type.apply(instruction, operands, out);
};

/// A type of rules has an overload for the operation.
template <class Rules, class Value, Op op>
concept Computes = requires(const Rules& rules, const Step<Value>& step, Value& out) {
  rules(Is<op>{}, step, out);
};

/// Calls the rule of the instruction's operation.
/// std::logic_error for operations that are resolved before anything is computed.
template <class Rules, class Value>
void dispatch(const Rules& rules, const Instruction& instruction, Operands<Value> operands,
              Value& out) {
  const Step<Value> step{instruction, operands};
  switch (instruction.op) {
#define GAINSMITH_RULE(op)                                                         \
  case Op::op:                                                                     \
    static_assert(Computes<Rules, Value, Op::op>,                                  \
                  "the rules of this number type forget the operation '" #op "'"); \
    rules(Is<Op::op>{}, step, out);                                                \
    return;
#define OPERATION(op, ...) GAINSMITH_RULE(op)
#define FUNCTION(op, ...) GAINSMITH_RULE(op)
#define RESOLVED(op, ...) \
  case Op::op:            \
    break;
#include "expr/operations.def"
#undef GAINSMITH_RULE
  }
  throw std::logic_error("the " + to_string(instruction.op) + " is not computed");
}

}  // namespace gainsmith::expr
