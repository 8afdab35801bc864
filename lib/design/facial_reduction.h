// What facial reduction (verdict/faces.h) makes of inequalities that none satisfies with room to
// spare: a point on their common face whose decimals hold, a chain of exact multipliers that
// excludes every solution, or nothing.
//
//   plain steps; nothing left to choose: the point, or a no
//   the largest margin on the face, in 31 digits: its point, rounded to decimals on the face;
//   from there to the least objective on the face, where one is stated
//   the multipliers made exact: a no, or a smaller face, and again; once more in 100 digits
#pragma once

#include <optional>

#include "design/attempt.h"

namespace gainsmith::design {

/// Whether a block states equations: an element of its diagonal is 0 for all unknowns.
bool states_equations(const lmi::Lmi& lmi);

/// The plain steps alone, and the largest margin of what they leave in double: a point that holds,
/// or a no; otherwise none.
std::optional<Attempt> attempt_on_equations(const Posed& posed, const Solve& solve);

/// None when nothing came of it; without a point and a no what it found is in left_open.
std::optional<Attempt> attempt_facial_reduction(const Posed& posed, const Solve& solve);

}  // namespace gainsmith::design
