// Problems without an interior, or whose optimum no point has.
#include "support/sdp_build.h"

namespace gainsmith::sdp::testing {
namespace {

/// min x s.t. [x, 1; 1, y] >= 0: 0, not attained.
CatalogueProblem not_attained() {
  CatalogueProblem result{"optimum not attained", empty({{2, false}}, 2)};
  result.problem.c = {1, 0};
  result.problem.f[0] = {{0, 0, 1, -1}};
  result.problem.f[1] = {{0, 0, 0, 1}};
  result.problem.f[2] = {{0, 1, 1, 1}};
  result.digits = 6;
  return result;
}

/// min x + y s.t. [x, 1; 1, y] >= 0, x >= 1 and x <= 1, the last two in a diagonal block.
CatalogueProblem no_interior() {
  CatalogueProblem result{"no interior", empty({{2, false}, {2, true}}, 2)};
  result.problem.c = {1, 1};
  result.problem.f[0] = {{0, 0, 1, -1}, {1, 0, 0, 1}, {1, 1, 1, -1}};
  result.problem.f[1] = {{0, 0, 0, 1}, {1, 0, 0, 1}, {1, 1, 1, -1}};
  result.problem.f[2] = {{0, 1, 1, 1}};
  result.optimum = 2;  // [x, 1; 1, y] >= 0 with x = 1: y = 1
  return result;
}

/// min x + y s.t. [x, 1, z; 1, y, z; z, z, 0] >= 0: z = 0, then x + y >= 2.
CatalogueProblem row_that_vanishes() {
  CatalogueProblem result{"a row that must vanish", empty({{3, false}}, 3)};
  result.problem.c = {1, 1, 0};
  result.problem.f[0] = {{0, 0, 1, -1}};
  result.problem.f[1] = {{0, 0, 0, 1}};
  result.problem.f[2] = {{0, 1, 1, 1}};
  result.problem.f[3] = {{0, 0, 2, 1}, {0, 1, 2, 1}};
  result.optimum = 2;
  return result;
}

/// [u, v w'; v w, X(x)] >= 0 around a planted X(x), u and v without a cost: at the optimum v = 0.
/// The dual asks for Y_11 = 0, so Y has no interior.
CatalogueProblem no_dual_interior(std::uint64_t seed) {
  constexpr int m = 4, n = 4;
  const CatalogueProblem inner = planted({"", {{n, false}}, m, {2}, seed});
  CatalogueProblem result{"no interior of the dual", empty({{n + 1, false}}, m + 2)};
  for (int i = 0; i <= m; ++i) {
    if (i > 0) result.problem.c[at(i) - 1] = inner.problem.c[at(i) - 1];
    for (Entry e : inner.problem.f[at(i)]) {
      ++e.row;
      ++e.column;
      result.problem.f[at(i)].push_back(e);
    }
  }
  result.problem.f[m + 1] = {{0, 0, 0, 1}};
  for (int k = 1; k <= n; ++k) result.problem.f[m + 2].push_back({0, 0, k, 1.0 / k});
  result.optimum = inner.optimum;
  return result;
}

}  // namespace

std::vector<CatalogueProblem> delicate_problems() {
  return {not_attained(), no_interior(), row_that_vanishes(), no_dual_interior(34)};
}

}  // namespace gainsmith::sdp::testing
