// Homogeneous inequalities whose solutions all have one scalar of one sign.
//
// Where a diagonal element of a strict block is c x_q and nothing else, every solution has c x_q >
// 0, and one of them x_q = sgn c: with that the inequalities have a constant part, in one unknown
// less. Multipliers Y of those, with r_i = 0 for i != q and v = -sgn(c) r_q >= 0, are multipliers
// of the homogeneous ones when v/|c| is added to that diagonal element of Y: then r_q = 0 too.
#pragma once

#include <optional>

#include "lmi/compile.h"
#include "lmi/unknowns.h"

namespace gainsmith::lmi {

struct Scale {
  int unknown = 0;  ///< q, counted from 1
  int sign = 1;     ///< of c
  std::size_t block = 0;
  int row = 0;  ///< of the diagonal element, from 0
};

/// Of the unknowns that are numbers, the one that occurs in the most elements; none where no such
/// diagonal element has one, or a block has a constant part.
std::optional<Scale> find_scale(const Lmi& lmi, const Unknowns& unknowns);

/// The inequalities with x_q = sgn c; the unknowns behind it move up by one.
Lmi scaled(const Lmi& lmi, const Scale& scale);

/// The number of unknown i there: 0 of x_q.
inline int scaled_number(int i, const Scale& scale) {
  return i == scale.unknown ? 0 : i > scale.unknown ? i - 1 : i;
}

}  // namespace gainsmith::lmi
