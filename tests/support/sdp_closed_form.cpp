// Problems whose optimum is a formula, an eigenvalue or a vertex.
#include <numbers>

#include "support/sdp_build.h"

namespace gainsmith::sdp::testing {
namespace {

/// The max-cut bound of a cycle: max L.Y/4, Y_ii = 1; by symmetry n lambda_max(L) / 4.
CatalogueProblem max_cut(int n) {
  CatalogueProblem result{"max-cut of a cycle", empty({{n, false}}, n)};
  MatrixXd laplacian = 2 * MatrixXd::Identity(n, n);
  for (int i = 0; i < n; ++i) {
    const int next = (i + 1) % n;
    laplacian(i, next) = laplacian(next, i) = -1;
    result.problem.c[at(i)] = 1;
    result.problem.f[at(i) + 1].push_back({0, i, i, 1});
  }
  put(result.problem.f[0], 0, 0.25 * laplacian);
  double largest = 0;
  for (int k = 0; k < n; ++k)
    largest = std::max(largest, 2 - 2 * std::cos(2 * std::numbers::pi * k / n));
  result.optimum = n * largest / 4;
  return result;
}

/// Lovasz's theta of a cycle of odd length n (Lovasz 1979): max J.Y, trace Y = 1, Y_ij = 0 along
/// the edges; n cos(pi/n) / (1 + cos(pi/n)), the square root of 5 for n = 5.
CatalogueProblem theta(int n) {
  CatalogueProblem result{"theta of a cycle", empty({{n, false}}, n + 1)};
  put(result.problem.f[0], 0, MatrixXd::Ones(n, n));
  put(result.problem.f[1], 0, MatrixXd::Identity(n, n));
  result.problem.c[0] = 1;
  for (int i = 0; i < n; ++i) {
    const int next = (i + 1) % n;
    result.problem.f[at(i) + 2].push_back({0, std::min(i, next), std::max(i, next), 1});
  }
  const double cosine = std::cos(std::numbers::pi / n);
  result.optimum = n * cosine / (1 + cosine);
  return result;
}

/// Symmetric, with the eigenvalues `lambda`.
MatrixXd with_eigenvalues(const VectorXd& lambda, std::uint64_t seed) {
  Random random(seed);
  const MatrixXd q = random.orthogonal(static_cast<int>(lambda.size()));
  const MatrixXd a = q * lambda.asDiagonal() * q.transpose();
  return 0.5 * (a + a.transpose());
}

/// min t s.t. t I - A >= 0: the largest eigenvalue, which is threefold; so Y is not unique.
CatalogueProblem largest_eigenvalue(std::uint64_t seed) {
  const VectorXd lambda{{2, 2, 2, -1, 0.5}};
  CatalogueProblem result{"largest eigenvalue, threefold", empty({{5, false}}, 1)};
  result.problem.c = {1};
  put(result.problem.f[0], 0, with_eigenvalues(lambda, seed));
  put(result.problem.f[1], 0, MatrixXd::Identity(5, 5));
  result.optimum = 2;
  return result;
}

/// min trace P s.t. P - A >= 0, P >= 0: the sum of A's positive eigenvalues. Two blocks, F_0 empty
/// in the second.
CatalogueProblem positive_part(std::uint64_t seed) {
  const VectorXd lambda{{3, 0.25, -2}};
  CatalogueProblem result{"positive part", empty({{3, false}, {3, false}}, 6)};
  put(result.problem.f[0], 0, with_eigenvalues(lambda, seed));
  int i = 0;
  for (int q = 0; q < 3; ++q)
    for (int p = 0; p <= q; ++p, ++i) {
      result.problem.c[at(i)] = p == q ? 1 : 0;
      for (const int block : {0, 1}) result.problem.f[at(i) + 1].push_back({block, p, q, 1});
    }
  result.optimum = lambda.cwiseMax(0).sum();
  return result;
}

/// min t s.t. [t I, B; B', t I] >= 0: the largest singular value of B.
CatalogueProblem spectral_norm(std::uint64_t seed) {
  Random random(seed);
  const MatrixXd b = random.matrix(2, 3);
  CatalogueProblem result{"spectral norm", empty({{5, false}}, 1)};
  result.problem.c = {1};
  MatrixXd f0 = MatrixXd::Zero(5, 5);
  f0.topRightCorner(2, 3) = -b;
  put(result.problem.f[0], 0, f0);
  put(result.problem.f[1], 0, MatrixXd::Identity(5, 5));
  result.optimum = tests::singular_values(b)[0];
  return result;
}

/// min t s.t. [t, (x - p)'; x - p, t I] >= 0 and x_1 <= 0 (diagonal block): the distance of p from
/// a half plane. An arrow, each x_i in two entries of it.
CatalogueProblem distance() {
  const VectorXd p{{3, 1, -2}};
  CatalogueProblem result{"distance from a half plane", empty({{4, false}, {1, true}}, 4)};
  result.problem.c = {1, 0, 0, 0};
  put(result.problem.f[1], 0, MatrixXd::Identity(4, 4));
  for (int i = 0; i < 3; ++i) {
    result.problem.f[0].push_back({0, 0, i + 1, p[i]});
    result.problem.f[at(i) + 2].push_back({0, 0, i + 1, 1});
  }
  result.problem.f[2].push_back({1, 0, 0, -1});
  result.optimum = p[0];
  return result;
}

/// min x + y s.t. [x, 1; 1, y] >= 0: 2 at x = y = 1, since x + y >= 2 sqrt(x y) >= 2.
CatalogueProblem means() {
  CatalogueProblem result{"arithmetic and geometric mean", empty({{2, false}}, 2)};
  result.problem.c = {1, 1};
  result.problem.f[0] = {{0, 0, 1, -1}};
  result.problem.f[1] = {{0, 0, 0, 1}};
  result.problem.f[2] = {{0, 1, 1, 1}};
  result.optimum = 2;
  return result;
}

/// max 3x + 2y s.t. x + y <= 4, x + 3y <= 6, x <= 3, x, y >= 0: 11 at (3, 1). As min -(3x + 2y).
CatalogueProblem linear_program() {
  CatalogueProblem result{"linear program", empty({{5, true}}, 2)};
  result.problem.c = {-3, -2};
  result.problem.f[0] = {{0, 0, 0, -4}, {0, 1, 1, -6}, {0, 2, 2, -3}};
  result.problem.f[1] = {{0, 0, 0, -1}, {0, 1, 1, -1}, {0, 2, 2, -1}, {0, 3, 3, 1}};
  result.problem.f[2] = {{0, 0, 0, -1}, {0, 1, 1, -3}, {0, 4, 4, 1}};
  result.optimum = -11;
  return result;
}

/// min sum t_i s.t. t_i >= |a_i - x|, a_i = 0, 1, 4, 6: any x from 1 to 4 is a median, the sum is
/// (6 - 0) + (4 - 1).
CatalogueProblem median() {
  const std::vector<double> a = {0, 1, 4, 6};
  CatalogueProblem result{"median, not unique", empty({{8, true}}, 5)};
  for (int i = 0; i < 4; ++i) {
    result.problem.c[at(i) + 1] = 1;
    result.problem.f[at(i) + 2] = {{0, 2 * i, 2 * i, 1}, {0, 2 * i + 1, 2 * i + 1, 1}};
    result.problem.f[1].push_back({0, 2 * i, 2 * i, 1});
    result.problem.f[1].push_back({0, 2 * i + 1, 2 * i + 1, -1});
    result.problem.f[0].push_back({0, 2 * i, 2 * i, a[at(i)]});
    result.problem.f[0].push_back({0, 2 * i + 1, 2 * i + 1, -a[at(i)]});
  }
  result.optimum = 9;
  return result;
}

/// max x + y s.t. x <= 1, y <= 1, x + y <= 2, 2 x + y <= 3: four lines through the optimal vertex.
CatalogueProblem degenerate_vertex() {
  CatalogueProblem result{"degenerate vertex", empty({{4, true}}, 2)};
  result.problem.c = {-1, -1};
  result.problem.f[0] = {{0, 0, 0, -1}, {0, 1, 1, -1}, {0, 2, 2, -2}, {0, 3, 3, -3}};
  result.problem.f[1] = {{0, 0, 0, -1}, {0, 2, 2, -1}, {0, 3, 3, -2}};
  result.problem.f[2] = {{0, 1, 1, -1}, {0, 2, 2, -1}, {0, 3, 3, -1}};
  result.optimum = -2;
  return result;
}

/// min x s.t. x - 2 >= 0, in a dense block of size one.
CatalogueProblem one_number() {
  CatalogueProblem result{"one number", empty({{1, false}}, 1)};
  result.problem.c = {1};
  result.problem.f[0] = {{0, 0, 0, 2}};
  result.problem.f[1] = {{0, 0, 0, 1}};
  result.optimum = 2;
  return result;
}

/// min x + 2 y s.t. x >= 1, y >= 2, x + y >= 5, each in a block of size one: 3 + 2 * 2, since
/// x + 2 y = (x + y) + y.
CatalogueProblem sizes_of_one() {
  CatalogueProblem result{"blocks of size one", empty({{1, false}, {1, true}, {1, false}}, 2)};
  result.problem.c = {1, 2};
  result.problem.f[0] = {{0, 0, 0, 1}, {1, 0, 0, 2}, {2, 0, 0, 5}};
  result.problem.f[1] = {{0, 0, 0, 1}, {2, 0, 0, 1}};
  result.problem.f[2] = {{1, 0, 0, 1}, {2, 0, 0, 1}};
  result.optimum = 7;
  return result;
}

}  // namespace

std::vector<CatalogueProblem> closed_forms() {
  return {
      max_cut(5),
      theta(5),
      largest_eigenvalue(22),
      positive_part(23),
      spectral_norm(24),
      distance(),
      means(),
      linear_program(),
      median(),
      degenerate_vertex(),
      one_number(),
      sizes_of_one(),
      direct_sum("a matrix, a vector and a number", {max_cut(5), linear_program(), one_number()})};
}

}  // namespace gainsmith::sdp::testing
