// The number type "enclosure": a matrix whose elements carry a bound of their error, so that what
// is said of the true value holds for the decimals as written, not up to rounding.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "expr/program/evaluate.h"
#include "expr/program/program.h"
#include "numbers/types/enclosed.h"

namespace gainsmith::numbers {

/// The true value is that of the operations in exact arithmetic on any true values of the operands.
/// Bounds are rigorous: roundings, truncated series, the error of functions of libm (2 units of the
/// last place) and of MPFR. An infinite radius says that nothing is known; more digits may help.
///
/// - A decimal that the scalar holds has radius 0.
/// - abs, sign, floor, mod, min, max, where: both branches where it is not certain which one holds.
/// - atan2: all angles where its jump may be inside. complement: nothing where a reflection may
///   turn over.
/// - jacobian: the slopes of both branches at a kink, nothing where there may be no derivative.
/// - sqrt: of the part >= 0 of its argument. log, division, inv and powers know nothing where their
///   argument may be singular, and fail where it certainly is.
/// - pinv needs full rank. orth and null: some exact orthonormal basis, of as many directions of
///   the range as the binder found, and of a kernel of the dimension that it found.
/// - The projections have no bound and are refused by name.
///
/// EvaluationError for what certainly has no value, and for a middle that is not finite. Elements
/// in units that are powers of two apart have the same digits (expm: numerics/balance.h).
template <class S>
struct Enclosure {
  using Value = Enclosed<S>;

  void apply(const expr::Instruction& instruction, expr::Operands<Value> operands,
             Value& out) const;
};

template <class S>
using EnclosedValues = std::map<std::string, Enclosed<S>, std::less<>>;

/// Evaluates once. EvaluationError when an operation fails; std::logic_error when an input has no
/// value.
template <class S>
Enclosed<S> enclose(const expr::Program& program, const EnclosedValues<S>& values);

/// Op::jacobian over balls, one column at a time by a jet (jet.h).
Enclosed<double> enclosed_jacobian(const expr::Instruction& instruction,
                                   const std::vector<Enclosed<double>>& operands);

/// Whether a decimal is an integer below 2^53 divided by a power of two: exact in every scalar.
bool is_exact_decimal(const std::string& decimal);

}  // namespace gainsmith::numbers
