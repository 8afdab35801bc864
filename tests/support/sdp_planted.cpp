// Problems around an optimum that was there first.
#include "support/sdp_build.h"

namespace gainsmith::sdp::testing {
namespace {

/// One F_i once more, doubled, at the doubled cost; and an F_i = 0 that costs nothing.
CatalogueProblem redundant(std::uint64_t seed) {
  CatalogueProblem result = planted({"redundant and empty F_i", {{5, false}}, 4, {2}, seed});
  auto doubled = result.problem.f[2];
  for (Entry& e : doubled) e.value *= 2;
  result.problem.f.push_back(doubled);
  result.problem.c.push_back(2 * result.problem.c[1]);
  result.problem.f.emplace_back();
  result.problem.c.push_back(0);
  return result;
}

}  // namespace

std::vector<CatalogueProblem> planted_problems() {
  return {planted({"planted, strict", {{6, false}}, 6, {3}, 11}),
          planted({"planted, not strict", {{6, false}}, 6, {2}, 12, 1}),
          planted({"planted, badly scaled", {{6, false}}, 8, {3}, 13, 0, 4}),
          planted({"planted, diagonal", {{8, true}}, 4, {4}, 25}),
          planted({"planted, diagonal, not strict", {{8, true}}, 3, {4}, 26, 1}),
          planted({"planted, all shapes",
                   {{4, false}, {3, true}, {1, false}, {1, true}, {3, false}},
                   7,
                   {2, 1, 1, 0, 1},
                   27}),
          planted({"planted, all shapes, badly scaled",
                   {{4, false}, {3, true}, {1, false}, {3, false}},
                   6,
                   {2, 1, 1, 1},
                   28,
                   0,
                   3}),
          planted({"planted, F_i empty in a block",
                   {{4, false}, {3, true}, {4, false}, {1, false}},
                   6,
                   {2, 1, 2, 1},
                   29,
                   0,
                   0,
                   3}),
          planted({"planted, F_i of two rows", {{12, false}}, 8, {7}, 30, 0, 0, 0, 2}),
          redundant(19)};
}

}  // namespace gainsmith::sdp::testing
