// Problems without a solution on one side or the other.
#include "support/sdp_build.h"

namespace gainsmith::sdp::testing {
namespace {

/// Symmetric, diagonal in a diagonal block.
MatrixXd random_block(const Block& block, Random& random) {
  const MatrixXd a = random.symmetric(block.size);
  return block.diagonal ? MatrixXd(a.diagonal().asDiagonal()) : a;
}

/// trace(F_i) = 0 over all blocks and F_0 = I/n: Y = I has F_0.Y = 1.
CatalogueProblem infeasible_primal(const std::string& name, const std::vector<Block>& blocks,
                                   std::uint64_t seed) {
  constexpr int m = 5;
  Random random(seed);
  int n = 0;
  for (const Block& block : blocks) n += block.size;
  CatalogueProblem result{name, empty(blocks, m), Answer::primal_infeasible};
  std::vector<Entry>& f0 = result.problem.f[0];
  for (std::size_t b = 0; b < blocks.size(); ++b)
    put(f0, static_cast<int>(b), MatrixXd::Identity(blocks[b].size, blocks[b].size) / n);
  for (int i = 0; i < m; ++i) {
    std::vector<MatrixXd> f;
    double trace = 0;
    for (const Block& block : blocks) trace += f.emplace_back(random_block(block, random)).trace();
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      f[b].diagonal().array() -= trace / n;
      put(result.problem.f[at(i) + 1], static_cast<int>(b), f[b]);
    }
    result.problem.c[at(i)] = random.number();
  }
  return result;
}

/// F_1 > 0 in every block with c_1 < 0: x = e_1 descends for ever.
CatalogueProblem infeasible_dual(const std::string& name, const std::vector<Block>& blocks,
                                 std::uint64_t seed) {
  constexpr int m = 4;
  Random random(seed);
  CatalogueProblem result{name, empty(blocks, m), Answer::dual_infeasible};
  for (int i = 0; i <= m; ++i) {
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      MatrixXd f = random_block(blocks[b], random);
      if (i == 1) f = f * f;
      put(result.problem.f[at(i)], static_cast<int>(b), f);
    }
    if (i > 0) result.problem.c[at(i) - 1] = i == 1 ? -1 : random.number();
  }
  return result;
}

/// x + y >= 2, x <= 0, y <= 0: the three add up to 0 >= 2.
CatalogueProblem empty_polyhedron() {
  CatalogueProblem result{"empty polyhedron", empty({{3, true}}, 2), Answer::primal_infeasible};
  result.problem.c = {1, -1};
  result.problem.f[0] = {{0, 0, 0, 2}};
  result.problem.f[1] = {{0, 0, 0, 1}, {0, 1, 1, -1}};
  result.problem.f[2] = {{0, 0, 0, 1}, {0, 2, 2, -1}};
  return result;
}

/// min y - x s.t. x >= y, y >= 1: x grows for ever.
CatalogueProblem unbounded_polyhedron() {
  CatalogueProblem result{"unbounded polyhedron", empty({{2, true}}, 2), Answer::dual_infeasible};
  result.problem.c = {-1, 1};
  result.problem.f[0] = {{0, 1, 1, 1}};
  result.problem.f[1] = {{0, 0, 0, 1}};
  result.problem.f[2] = {{0, 0, 0, -1}, {0, 1, 1, 1}};
  return result;
}

/// x >= 1 and x <= 0, in two blocks of size one.
CatalogueProblem empty_interval() {
  CatalogueProblem result{"empty interval", empty({{1, false}, {1, false}}, 1),
                          Answer::primal_infeasible};
  result.problem.c = {1};
  result.problem.f[0] = {{0, 0, 0, 1}};
  result.problem.f[1] = {{0, 0, 0, 1}, {1, 0, 0, -1}};
  return result;
}

/// min -x s.t. x >= 1, in a block of size one.
CatalogueProblem ray() {
  CatalogueProblem result{"ray", empty({{1, false}}, 1), Answer::dual_infeasible};
  result.problem.c = {-1};
  result.problem.f[0] = {{0, 0, 0, 1}};
  result.problem.f[1] = {{0, 0, 0, 1}};
  return result;
}

CatalogueProblem neither() {
  CatalogueProblem result =
      direct_sum("infeasible on both sides", {empty_polyhedron(), unbounded_polyhedron()});
  result.answer = Answer::both_infeasible;
  return result;
}

/// An F_i = 0 that pays for itself.
CatalogueProblem free_descent(std::uint64_t seed) {
  CatalogueProblem result = planted({"empty F_i with a cost", {{4, false}}, 3, {2}, seed});
  result.answer = Answer::dual_infeasible;
  result.problem.f.emplace_back();
  result.problem.c.push_back(0.5);
  return result;
}

/// A dependent F_i with an inconsistent cost: x along the difference descends for ever.
CatalogueProblem inconsistent(std::uint64_t seed) {
  CatalogueProblem result =
      planted({"dependent F_i, inconsistent cost", {{4, false}}, 3, {2}, seed});
  result.answer = Answer::dual_infeasible;
  result.problem.f.push_back(result.problem.f[1]);
  result.problem.c.push_back(result.problem.c[0] + 0.5);
  return result;
}

/// [x, 1; 1, 0] >= 0 for no x, though nearly for large ones.
CatalogueProblem weakly_infeasible() {
  CatalogueProblem result{"weakly infeasible", empty({{2, false}}, 1), Answer::weakly_infeasible};
  result.problem.c[0] = 1;
  result.problem.f[0] = {{0, 0, 1, -1}};
  result.problem.f[1] = {{0, 0, 0, 1}};
  return result;
}

/// min -2 y s.t. [x, y; y, 1] >= 0: y^2 <= x, so y grows for ever; but no x, y with -2 y = -1 has
/// [x, y; y, 0] >= 0, only nearly so for large x. The dual asks for Y_11 = 0 and Y_12 = -1.
CatalogueProblem weakly_unbounded() {
  CatalogueProblem result{"weakly unbounded", empty({{2, false}}, 2), Answer::weakly_infeasible};
  result.problem.c = {0, -2};
  result.problem.f[0] = {{0, 1, 1, -1}};
  result.problem.f[1] = {{0, 0, 0, 1}};
  result.problem.f[2] = {{0, 0, 1, 1}};
  return result;
}

}  // namespace

std::vector<CatalogueProblem> infeasible_problems() {
  const std::vector<Block> shapes = {{4, false}, {3, true}, {1, false}, {2, false}};
  const CatalogueProblem feasible = planted({"", shapes, 5, {2, 1, 1, 1}, 31});
  return {infeasible_primal("primal infeasible", {{6, false}}, 17),
          infeasible_primal("primal infeasible, all shapes", shapes, 32),
          infeasible_dual("dual infeasible", {{5, false}}, 18),
          infeasible_dual("dual infeasible, all shapes", shapes, 33),
          empty_polyhedron(),
          unbounded_polyhedron(),
          empty_interval(),
          ray(),
          neither(),
          direct_sum("one part primal infeasible", {feasible, empty_interval()}),
          direct_sum("one part dual infeasible", {feasible, ray()}),
          free_descent(20),
          inconsistent(21),
          weakly_infeasible(),
          weakly_unbounded()};
}

}  // namespace gainsmith::sdp::testing
