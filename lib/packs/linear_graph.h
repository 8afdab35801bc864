// The code of linear packs from their tables: what linear_system.h says, operation by operation.
#pragma once

#include "packs/length_table.h"
#include "packs/linear_system.h"

namespace gainsmith::packs {

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

}  // namespace gainsmith::packs
