// A no on the boundary of the cone, by an eigenvalue on the wrong side.
//
// Feasibility may hang on an eigenvalue, as with an unstable A and P > 0, He(P*A) < 0. Then every
// certificate is singular, and no digits of it are a proof. With A w = l w, m the conjugate of l,
//   w*(-He(P*A))w + (l + m) w*P w = 0   for every P:
// w w* and (l + m) w w* are multipliers of both inequalities if l + m >= 0. In general
//   Y_k = c_k z_k z_k*,   c_k = e*W_k e, z_k = Z_k e,   e = (1, l, ..., l^(d-1))', p(l) = 0
// with rational W_k, Z_k and p of degree d. A matrix X stands for e*X e in the ring
// Q[l, m]/(p(l), p(m)), and for 0 only if X = 0; l e = C e with the companion matrix C of p, so
// that times l is X C and times m is C'X. All equations are checked in this ring, in fractions.
// What remains are signs at one root.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lmi/compile.h"
#include "lmi/inequalities.h"
#include "verdict/algebraic_root.h"

namespace gainsmith::verdict {

/// Y = c z z* of one block, c = W_00 + W_01 (l + m) + W_11 l m and z = Z e: n_k x n_k, of rank 1.
struct AlgebraicMultiplier {
  std::size_t block = 0;
  numerics::RationalMatrix Z;  ///< n_k x d
  numerics::RationalMatrix W;  ///< 2 x 2: of 1, l + m and l m
  int step = 1;                ///< of a chain of rational ones (faces.h)
};

/// W of the weight c alone.
numerics::RationalMatrix weight(const Rational& c);

/// Its real part in double, n_k x n_k: B_ki are real.
numbers::Matrix rounded(const AlgebraicMultiplier& multiplier, const Root& root);

/// Multipliers that exclude every solution at the root `root` of p. The equations hold in the ring;
/// the signs c_k >= 0 and the constant part < 0 (or 0 beside a strict block) hold at this root.
struct AlgebraicCertificate {
  std::string matrix;  ///< whose eigenvalue it is: "A", "A'", "a matrix of decrease"
  Polynomial p;
  Root root;
  std::vector<AlgebraicMultiplier> multipliers;
};

/// One that excludes every solution; the eigenvalues of all constant matrices of the inequalities
/// are tried. None where no eigenvalue decides.
/// Matrices of more than 12 rows are not tried.
std::optional<AlgebraicCertificate> algebraic_certificate(const lmi::Inequalities& of,
                                                          const lmi::Lmi& lmi);

}  // namespace gainsmith::verdict
