// Bounds of what becomes of z and its error over a block of flows, |M(s)| at most what its table says.
//
//   |z+| <= (M + K) |z|,   |G+| <= (M + K) |G|,   b+ = M b + K (|z| + root |row of G| + b)
//
// with M the sizes of the table and K |v| its errors and what rounding makes of M v and of M G. So of
// all numbers of flows up to a block, from z, b and rho = root |row of G| at its start, a = |z| + rho + b,
//
//   |z|, rho, b <= growth |z|, growth rho, growth b + added a
#pragma once

#include <cstdint>

#include "linear/length_table.h"
#include "numbers/matrix.h"

namespace gainsmith::linear {

struct BlockBounds {
  numbers::Matrix growth, added;
};

/// `table`: M, `rank` rows, is its first functions; one more column with a constant.
BlockBounds block_bounds(const LengthTable& table, std::size_t rank, bool constant,
                         std::int64_t flows);

}  // namespace gainsmith::linear
