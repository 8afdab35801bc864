// From a point in floating point to an identity in fractions (Peyrl and Parrilo 2008).
//
// The Gram matrices of a point with Q >= t I, t > 0, are rounded to fractions, and moved a little
// so that all equations hold exactly. Moved by less than t in norm they are positive definite,
// which is then shown for each of them.
#pragma once

#include <optional>
#include <vector>

#include "numbers/types/rational.h"
#include "sos/solve.h"

namespace gainsmith::sos {

/// Values with which all equations of a program hold exactly, Q_j > 0 for each Gram matrix.
struct Identity {
  std::vector<numbers::RationalMatrix> grams;
  std::vector<Rational> free;  ///< u, then t
};

/// With the decimals u; none where the equations leave no Gram matrices for them, or none near the
/// point that are shown to be positive definite. All else is rounded to some 13 digits; what an
/// equation is off by then goes evenly to the elements that no other equation has, and otherwise by
/// the least change.
std::optional<Identity> identity_near(const Program& program, const Point& point,
                                      const std::vector<Rational>& u);

/// Equations that u alone must satisfy so that the others have a solution: where bases are those of
/// a face, the values at its zeros, say.
std::vector<Equation> conditions_on_unknowns(const Program& program);

/// Decimals near u, 14 digits of the largest, that satisfy the conditions exactly; none where only
/// other fractions do, or u is not finite.
std::optional<std::vector<Rational>> decimals_near(const std::vector<double>& u,
                                                   const std::vector<Equation>& conditions);

/// With these many decimals a number of that size has so many digits.
int decimals_for(double largest, int digits);

/// x with so many decimals.
Rational rounded_to(const Rational& x, int decimals);

/// Whether it is shown, in 31 digits or in fractions, that Q > 0.
bool is_shown_definite(const numbers::RationalMatrix& Q);

}  // namespace gainsmith::sos
