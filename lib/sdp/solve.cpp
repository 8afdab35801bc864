#include "base/isa.h"
#include "sdp/core/variant.h"

namespace gainsmith::sdp {

#ifdef GAINSMITH_VARIANTS
extern "C" const Variant v3_gainsmith_sdp;
#endif

namespace {

/// The code for x86-64-v3, unless isa() (base/isa.h) is x86-64-v2 or there is no such code.
const Variant& variant() {
#ifdef GAINSMITH_VARIANTS
  if (isa() != "v2") return v3_gainsmith_sdp;
#endif
  return gainsmith_sdp;
}

}  // namespace

Solution solve(const Problem& problem, const Options& options) {
  return variant().solve_scalars(problem, options);
}

Solution solve(const MatrixProgram& program, const MatrixOptions& options) {
  return variant().solve_matrices(program, options);
}

}  // namespace gainsmith::sdp
