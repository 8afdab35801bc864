// What a certificate says of the inequalities themselves, evaluated from the decimals of the file.
//
// Multipliers Y_k > 0 of the blocks, v = -sum_k <B_k0, Y_k> (y_0 of the block x_0 > 0 of the
// homogenised inequalities), r_i = sum_k <B_ki, Y_k> for i >= 1, r_0 = 0.
//
//   exact   r' H^-1 r < 1 with H_ij = sum_k <B_ki, Y_k B_kj Y_k> (+ v^2 for i = j = 0): a
//           certificate without any residual is near (exactness.h), so no x satisfies the
//           inequalities. It does not depend on units or coordinates.
//   backward error, relative
//           max over i >= 1 of |r_i| / W_i, W_i = sum_k <|B_ki|, |Y_k|>: no x satisfies the
//           inequalities when their coefficients change by more than that, relatively; and within
//           such changes Y is exact for some coefficients (Oettli & Prager).
//           Where an element of the data is smaller than 1e-40 beside its block, the error counts
//           in its size. An element of B_ki that is 0 up to rounding, 48 decades below its block,
//           is none.
#pragma once

#include <memory>
#include <vector>

#include "lmi/compile.h"
#include "lmi/formulation.h"
#include "verdict/algebraic_multipliers.h"
#include "verdict/exact.h"
#include "verdict/solved_multipliers.h"

namespace gainsmith::verdict {

/// What multipliers say of the inequalities. Without multipliers it says nothing: an error of 1.
struct Refutation {
  bool exact = false;         ///< no solution, shown
  double backward_error = 1;  ///< rounded upward
  int digits = 0;             ///< of the arithmetic that found it
  std::shared_ptr<const AlgebraicCertificate> algebraic = nullptr;  ///< in fractions
};

/// In which arithmetic an exact certificate is searched for beside the multipliers.
enum class Exactness { in_double, in_wide };

/// What Y says over S, or those of its Y_k that are not small: those of blocks that a certificate
/// does not need are only nearly 0, and any Y >= 0 may be tried. Nothing (an error of 1) when the
/// Y_k are not positive semidefinite, or when only blocks with >= have multipliers and v is 0. It
/// is about the inequalities where every block represents a point of its domain.
template <class S>
Refutation refute(const lmi::Inequalities& of, const lmi::Lmi& lmi,
                  const lmi::Formulation& formulation, const Multipliers& Y,
                  Exactness exactness = Exactness::in_wide);

/// The blocks of the Lmi in the balance of a formulation, on the rows that were solved.
/// One for each block, its kept rows only.
template <class S>
std::vector<ExactBlock<S>> exact_blocks(const lmi::Inequalities& of, const lmi::Lmi& lmi,
                                        const lmi::Formulation& formulation);

/// The same of blocks that are known, and multipliers in the same digits.
template <class S>
Refutation refute(const lmi::Lmi& lmi, const std::vector<ExactBlock<S>>& blocks,
                  std::vector<numbers::MatrixOf<S>> Y, Exactness exactness = Exactness::in_wide);

/// The backward error of a certificate of which nothing is missing, in 100 digits. A feasible
/// problem has certificates that miss by the square of what it is feasible by, 1e-33 where only the
/// last of 16 digits makes it feasible, and along chains and Jordan blocks by higher powers: no
/// such limit is a proof, and only `exact` is one. It is far below what data of 16 digits were seen
/// to leave.
constexpr double kNothing = 1e-70;

}  // namespace gainsmith::verdict
