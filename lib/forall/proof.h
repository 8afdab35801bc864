// That an inequality holds for all values of its variables, for every text and with the errors of
// the arithmetic, or a point where it fails.
//
//   B(t) > 0 for all t in a box,   B symmetric, given as a program.
//
// On a piece of the box with edges w_i, B differs from the multilinear interpolation of its corners
// by at most
//   E = sum_i min(w_i/2 rad(B'_i), w_i^2/8 |B''_i|)   element by element,
// with enclosures of the slopes B'_i and of B''_i over the piece (numbers/types/jet.h); slopes in a
// ball of radius r leave a chord by at most r w/2, so that kinks need no B''. B > 0 on the piece
// when B(c) + F > 0 for all |F| <= E at each corner c (numbers/dense/definite.h), since the
// interpolation is a mean of the corners. Where all B''_i are known it is enough that B(c) - sum_i
// theta_i w_i^2/8 B''_i > 0 for theta_i = 0 and 1: B lies below the chord by these, and their sign
// and direction count. Where a slope has no bound (cusps, jumps) the enclosure of B over the piece
// has to be positive definite itself. A piece that does not pass is cut in two, as far as doubles
// go.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "expr/program/program.h"
#include "forall/domain.h"
#include "numbers/types/enclosure.h"

namespace gainsmith::forall {

struct ProofOptions {
  std::size_t most_pieces = 20000;  ///< of the whole domain
};

struct DomainProof {
  enum class Status {
    holds,  ///< certain, for every value within the enclosures of what is known
    fails,  ///< certain at `point`: v'Bv <= 0 (strict) or v'Bv < 0 for v = `direction`
    open
  };
  Status status = Status::holds;
  std::optional<Point> point;
  numbers::Vector direction;
  std::string where;   ///< open: "k = 2, tau in [0.2, 0.25]"
  std::string reason;  ///< open: "the sign at a point is within its error bound"
  double margin = 1;   ///< the smallest numbers::margin at the points examined
  std::size_t pieces = 0;
};

/// What the elements of sets and the vertices of polytopes are; without an entry they are the
/// doubles of the domain.
template <class S>
using EnclosedElements = std::map<std::string, std::vector<numbers::Enclosed<S>>, std::less<>>;

/// Points are examined in S, pieces in double. `known`: data, parameters, unknowns as printed.
/// Intervals are as wide as the domain says: ends that are not doubles have to be rounded outward
/// there. The vertices of polytopes represent them, as B is affine in such a variable. With
/// `strict` false it is B >= 0 that is shown: by B > 0, but for rows that are exactly 0.
///
/// More digits may settle what is open at a point; `reason` says where that is so.
template <class S>
DomainProof prove_on_domain(const expr::Program& difference, const Domain& domain,
                            const numbers::EnclosedValues<S>& known, bool strict,
                            const EnclosedElements<S>& elements = {},
                            const ProofOptions& options = {});

}  // namespace gainsmith::forall
