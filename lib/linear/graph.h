// The code of linear packs from their tables: what system.h says, operation by operation.
#pragma once

#include "linear/length_table.h"
#include "linear/system.h"

namespace gainsmith::linear {

/// Over lengths: of a first flow and of those behind jumps, M, F, F_end and C; of the rest of a
/// flow, its end and C; of whole lengths F; of what is left of a length the factors.
struct LinearTables {
  const PieceTable& first;
  const LengthTable& step;
  const PieceTable& rest;
  const LengthTable& length;
  const LengthTable& left;
};

void add_code(const LinearTables& tables, LinearSystem& system);

}  // namespace gainsmith::linear
