// Internal to design: what a face (verdict/faces.h) leaves of inequalities, as a program for a
// solver, and what its solution says of the blocks of the face.
#pragma once

#include <cstddef>
#include <vector>

#include "lmi/formulation.h"
#include "sdp/solution.h"
#include "verdict/face_multipliers.h"
#include "verdict/faces.h"

namespace gainsmith::design {

/// The blocks that have rows left, and c'x in the coordinates of the face, x = x_0 + N y.
struct FaceProgram {
  lmi::Lmi lmi;
  std::vector<std::size_t> blocks;  ///< which of the faces' they are
};

/// Coefficients are rounded to doubles. `stated`: the inequalities of the whole space.
FaceProgram program_on(const verdict::Faces& faces, const lmi::Lmi& stated);

/// The program of the largest margin, its coefficients rounded once from fractions to 31 digits.
lmi::Formulation formulate(const verdict::Faces& faces, const FaceProgram& program,
                           const lmi::Round& round);

/// A solution of that program.
struct FaceSolution {
  sdp::Solution solution;
  lmi::Formulation formulation;
};

/// The multipliers of the blocks on the face, and v of their constant parts.
verdict::FoundMultipliers multipliers_on(const verdict::Faces& faces, const FaceProgram& program,
                                         const FaceSolution& solved);

/// Projectors K K' onto the kernels of the blocks at the point of the largest margin, K the
/// eigenvectors of small eigenvalues. A face of all solutions has B_k(x) V = 0, so its range is in
/// them.
verdict::FoundMultipliers kernels_on(const verdict::Faces& faces, const FaceProgram& program,
                                     const FaceSolution& solved);

}  // namespace gainsmith::design
