// Arithmetic of affine forms, under the contract of expr/program/number_type.h.
#pragma once

#include <span>

#include "expr/program/number_type.h"
#include "lmi/affine.h"

namespace gainsmith::lmi {

/// Sums, products with what has no unknown, blocks, transposes and the like are
/// affine; any function may be applied to constants; exp, sin and cos also to an affine function of
/// one variable, and expm to M + F*tau with M F = F M (forall/residues.h). Everything else throws
/// EvaluationError with the unknown, or the function of tau, at fault.
struct AffineAlgebra {
  using Value = AffineForm;

  forall::MonomialTable* monomials = nullptr;
  const Unknowns* unknowns = nullptr;

  void apply(const expr::Instruction& instruction, std::span<const AffineForm* const> operands,
             AffineForm& out) const;
};

}  // namespace gainsmith::lmi
