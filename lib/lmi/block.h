// From a matrix inequality as text to blocks  B(x) = B_0 + sum_i x_i B_i  that must be >= 0.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "forall/domain.h"
#include "lmi/affine.h"
#include "lmi/unknowns.h"

namespace gainsmith::lmi {

/// One symmetric block. `terms` are (i, B_i) in the order of i, with i = 0 the constant. With
/// `products` those of the scalars of their matrices V are
///   sum over t of He(E_t V_t F_t)
/// and nothing else; other matrices may occur in terms by their scalars.
struct Block {
  std::string name;    ///< of the requirement, "name.2" for the second comparison of a chain
  std::string point;   ///< "tau = 0.7", "cos(2*tau) = 1"; empty without forall
  std::size_t at = 0;  ///< which of the points it was imposed at, see forall::Imposed
  bool strict = true;
  std::size_t inequality = 0;  ///< its index in the method
  std::size_t comparison = 0;  ///< of its chain
  /// The values of all variables there. None: it represents no point of the domain, as a corner of
  /// a box that the functions of a variable do not reach.
  std::optional<forall::Point> where;
  int size = 0;
  std::vector<std::pair<int, Sparse>> terms;
  std::optional<std::vector<HermitianProduct>> products;
  /// b: largest |element| of B_0; c: largest |element| of the other B_i.
  double constant_size = 0;
  double coefficient_size = 0;

  /// B(x), for m scalars x, its constant part times `one`.
  numbers::Matrix value(const std::vector<double>& x, double one = 1) const;
};

/// Whether no block has a constant term: then x = 0 satisfies every inequality but for strictness.
bool is_homogeneous(const std::vector<Block>& blocks);

/// The block of a symmetric affine form without monomials. InputError, at `place`, when it is not
/// symmetric up to 1e-12 of its largest element (what is, is made so exactly), has no rows, or has
/// a coefficient that is not finite.
Block block_of(const AffineForm& form, std::string name, std::string point, bool strict,
               const Place& place);

}  // namespace gainsmith::lmi
