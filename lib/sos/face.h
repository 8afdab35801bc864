// The face of the Gram matrices on which all solutions lie.
//
// Where a polynomial is 0 at z, m(z) is in the kernel of its Gram matrix. z may be irrational, but
// zeros that are conjugate come together, so the kernel that a solution in floating point shows has
// a reduced echelon form in fractions. Nothing rests on that guess: what follows from it is an
// identity in fractions, or nothing.
#pragma once

#include <optional>

#include "sos/solve.h"

namespace gainsmith::sos {

/// The program with Q = W Z W' for the Gram matrices that are nearly singular at the point, the
/// columns of W orthogonal to the kernel, and W'z for their bases. The kernels are the shortest
/// fractions near those of the point with which the equations agree with each other; none where no
/// fractions are that.
std::optional<Program> restricted_to_faces(const Program& program, const Point& point);

}  // namespace gainsmith::sos
