// Bounds on gains, so that an infimum that is only approached with ever larger gains still gives
// gains that can be built.
//
// A gain formula that holds inv(S)*E (or E*inv(S)), S a symmetric unknown and E affine in the
// unknowns, is bounded by beta through a scalar s of its own:
//   S >= s I,   [ S , E/beta ; * , s I ] >= 0    <=>    E' inv(S) E <= beta^2 s I,
//   s <= lambda_min(S).
// With G = inv(S) E that is G' S G <= beta^2 lambda_min(S), so the largest singular value of G is
// at most beta. It does not change when the unknowns are scaled together. The condition is
// sufficient: an ill-conditioned S may exclude gains below beta.
//
// Of an S that is not symmetric (S - s I)(S - s I)' >= 0 says S S' >= s (S + S') - s^2 I, so that
//   [ S + S' - s I , E/beta ; * , s I ] >= 0   =>   E E' <= beta^2 S S'.
// A gain K that is affine in the unknowns is bounded by its largest singular value:
// [ I , K/beta ; * , I ] >= 0, which has a constant part.
//
// A gain that is a function of a scalar is bounded coefficient by coefficient: inv(S)*Y_k for
// inv(S)*Y(tau), and the matrix that each function theta(tau) in it multiplies. That bounds a gain
// at vertices itself, of a polynomial its coefficients. With Chebyshev polynomials, or an inverse
// of a function, it is bounded at the ends of the variable's interval and at extrema between them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lmi/compile.h"
#include "model/gains.h"

namespace gainsmith::lmi {

/// The bound on one product. `s` and `e` are forms in the unknowns; both are transposed for
/// E*inv(S).
struct BoundedProduct {
  std::string what;  ///< "inv(P1)*Y"
  AffineForm s;      ///< n x n
  AffineForm e;      ///< n x k
  int scalar = 0;    ///< index of the scalar s among the variables; 0: S is the identity and s = 1
  double share = 1;  ///< of beta, that bounds it
  bool symmetric = true;  ///< S is
};

struct GainBounds {
  double beta = 0;         ///< the largest bound
  std::vector<int> units;  ///< log2 d_i of each unknown (balance.h); empty: those of the problem
  std::vector<BoundedProduct> list;
  std::vector<Block> blocks;  ///< all non-strict, in terms of the unknowns and the scalars s
  int scalars = 0;            ///< number of scalars s, with the indices m + 1, m + 2, ...
};

/// One bound for each different product in the gain formulas: inv(S) with all factors beside it, or
/// with the nearest where their product is not affine; none where that is not either, and none
/// without `beta`.
///
/// With `units` (log2 d_i, balance.h) beta is meant in balanced units: with powers of two T and U,
/// T S T and T E U replace S and E, so that their elements are near 1 in these units. Nothing
/// depends on the units of the problem then.
GainBounds gain_bounds(const Inequalities& inequalities, std::optional<double> beta,
                       std::vector<int> units = {});

/// As the problem asks: a bound that it states is meant in its own units, the default in balanced
/// ones.
GainBounds gain_bounds(const Inequalities& inequalities, const Lmi& lmi);

/// How far each bound is used at x: sqrt(lambda_max(E' inv(S) E) / lambda_min(S)), never less than
/// the largest singular value of the gain, which it is where S is not symmetric. Infinite where S
/// is not definite or not invertible. `active` here: above 99 % of the bound.
std::vector<model::GainBound> reached_bounds(const GainBounds& bounds,
                                             const std::vector<double>& x);

}  // namespace gainsmith::lmi
