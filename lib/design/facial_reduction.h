// What facial reduction (Borwein & Wolkowicz 1981, verdict/faces.h) makes of inequalities that none
// satisfies with room to spare: a point on their common face whose decimals hold, a chain of exact
// multipliers that excludes every solution, or nothing.
//
//   plain steps, equations among them; nothing left to choose: the point, or a no
//   the largest margin on the face, in double and in 31 digits: its point, rounded to decimals on
//   the face; from there to the least objective on the face, where one is stated, with a lower
//   bound that weak duality shows there
//   the multipliers made exact: a no, or a smaller face, and again
//   the kernels of the blocks at that point in fractions nearby: a smaller face, shown by exact
//   multipliers on it or only guessed, and again; once more in 100 digits
#pragma once

#include <optional>

#include "design/attempt.h"

namespace gainsmith::design {

/// Whether a block states equations: an element of its diagonal is 0 for all unknowns.
bool states_equations(const lmi::Lmi& lmi);

/// None when nothing came of it; without a point and a no what it found is in left_open. With
/// bounds on gains: a point within them, by the plain steps alone, or nothing that counts.
std::optional<Attempt> attempt_facial_reduction(const Posed& posed, const lmi::GainBounds& bounds,
                                                const Solve& solve);

}  // namespace gainsmith::design
