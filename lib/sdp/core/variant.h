// The solvers as one kind of machine runs them.
//
// The sources of this room are compiled for every x86-64 machine, and again for those of
// x86-64-v3 (AVX2, FMA). In the object of the second all names begin with v3_, so that no function
// that both have is shared between them (cmake/GainsmithVariant.cmake).
#pragma once

#include "sdp/schur/matrix_solver.h"
#include "sdp/solver.h"

namespace gainsmith::sdp {

/// The entry points of one compiled variant; solve.cpp chooses one by the machine.
struct Variant {
  Solution (*solve_scalars)(const Problem& problem, const Options& options);
  Solution (*solve_matrices)(const MatrixProgram& program, const MatrixOptions& options);
};

/// What solver.h and matrix_solver.h say, as compiled here.
Solution solve_here(const Problem& problem, const Options& options);
Solution solve_here(const MatrixProgram& program, const MatrixOptions& options);

extern "C" const Variant gainsmith_sdp;

}  // namespace gainsmith::sdp
