// One root l of a polynomial p with rational coefficients, and what is known of it exactly.
//
// Polynomials are their coefficients from the constant one on; the leading one is 1.
#pragma once

#include <vector>

#include "numerics/rational_matrix.h"

namespace gainsmith::verdict {

/// p_0 ... p_d with p_d = 1.
using Polynomial = std::vector<Rational>;

/// p without its multiple roots.
/// p / gcd(p, p').
Polynomial square_free(const Polynomial& p);

/// The companion matrix C, d x d, with ones above the diagonal and -p_0 ... -p_(d-1) in the last
/// row: l e = C e for e = (1, l, ..., l^(d-1))' at every root l of p.
numerics::RationalMatrix companion(const Polynomial& p);

/// Factors of a square-free p on which a stability limit may hang, and p itself: x - a for each
/// root a that is a short fraction, and what p has in common with p(-x) and with x^d p(1/x).
std::vector<Polynomial> factors_to_try(const Polynomial& p);

/// The only root of p in the disk of radius h about re + i im. It is real where im is 0.
struct Root {
  Rational re, im;
  Rational h;
  bool imaginary = false;  ///< its real part is 0
  bool on_circle = false;  ///< its modulus is 1

  /// A value x with |true - x| <= error.
  struct Bounded {
    Rational x, error;
  };
  /// l + conj(l).
  Bounded twice_real() const;
  /// |l|^2 = l conj(l); 1 without an error on the circle.
  Bounded squared_modulus() const;
};

/// The roots, each in a disk of its own: by Rouche's theorem where |p| + M h^2/2 < |p'| h at the
/// centre, M >= |p''| on the disk. One that is not told apart is left out. The disk of a polynomial
/// whose coefficients say that roots lie in mirror images shows more: a root whose disk is its own
/// image in the real axis is real; in the imaginary axis, imaginary; 1/conj(l) in the same disk, of
/// modulus 1.
std::vector<Root> roots(const Polynomial& p);

/// e*X e = sum over (i, j) of X_ij conj(l)^i l^j, X symmetric.
Root::Bounded form_at(const Root& l, const numerics::RationalMatrix& X);

}  // namespace gainsmith::verdict
