// What facial reduction (lmi/faces.h) makes of inequalities that none satisfies with room to spare:
// a point on their common face whose decimals hold, a chain of exact multipliers that excludes
// every solution, or nothing.
//
//   plain steps; nothing left to choose: the point, or a no
//   the largest margin on the face, in 31 digits: its point, rounded to decimals on the face;
//   from there to the least objective on the face, where one is stated
//   the multipliers made exact: a no, or a smaller face, and again; once more in 100 digits
#pragma once

#include <optional>

#include "design/attempt.h"

namespace gainsmith::design {

/// None when nothing came of it; without a point and a no what it found is in left_open.
std::optional<Attempt> attempt_on_faces(const Posed& posed, const Solve& solve);

}  // namespace gainsmith::design
