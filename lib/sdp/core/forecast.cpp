#include "sdp/core/forecast.h"

#include "base/error.h"
#include "base/memory.h"
#include "base/number.h"

namespace gainsmith::sdp {

void require_memory(int m, double bytes) {
  constexpr double kSmall = 1e7;  // always there
  constexpr double kGigabyte = 1e9;
  if (bytes < kSmall) return;
  const double limit = memory_limit();
  if (bytes <= limit) return;
  throw InputError({}, "the semidefinite program has " + std::to_string(m) +
                           " unknowns and would take " + brief(bytes / kGigabyte, 3) +
                           " GB of memory; there are " + brief(limit / kGigabyte, 3) +
                           " GB. Fewer states, or unknowns with more structure (diagonal, block), "
                           "take less; 'synth --sdpa FILE --no-solve' writes the program for "
                           "another solver");
}

}  // namespace gainsmith::sdp
