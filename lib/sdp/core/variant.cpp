#include "sdp/core/variant.h"

namespace gainsmith::sdp {

extern "C" const Variant gainsmith_sdp = {solve_here, solve_here};

}  // namespace gainsmith::sdp
