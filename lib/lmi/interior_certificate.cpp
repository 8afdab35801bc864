#include "lmi/interior_certificate.h"

#include <cmath>

namespace gainsmith::lmi {

sdp::Problem interior_certificate_program(const Formulation& interior) {
  sdp::Problem problem = interior.problem;
  const std::size_t margin = problem.c.size();
  const auto limit = static_cast<int>(problem.blocks.size()) - 1;
  // The largest margin has B_k(x) - s I and N - sum tr B_k(x).
  for (std::size_t i = 1; i <= margin; ++i)
    for (sdp::Entry& entry : problem.f[i])
      if (entry.block == limit || i == margin) {
        entry.value = -entry.value;
        entry.rest = -entry.rest;
      }
  for (sdp::Entry& entry : problem.f[0])
    if (entry.block == limit) entry.value = 1;
  problem.f[margin].push_back({limit, 0, 0, static_cast<double>(interior.rows)});
  problem.c[margin - 1] = 1;
  return problem;
}

void add_depth(sdp::Solution& solution) {
  auto& blocks = solution.Y.values;
  const double t = blocks.back().front();
  if (getenv("GSDEBUG")) fprintf(stderr, "t %g its %d status %s gap %g\n", t, solution.iterations, to_string(solution.cause).c_str(), solution.relative_gap);
  for (std::size_t k = 0; k + 1 < blocks.size(); ++k) {
    const auto n = static_cast<std::size_t>(std::lround(std::sqrt(blocks[k].size())));
    for (std::size_t i = 0; i < n; ++i) blocks[k][i * (n + 1)] += t;
  }
}

}  // namespace gainsmith::lmi
