#include "support/sdp_catalogue.h"

#include <Eigen/Dense>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

#include "base/random.h"

namespace gainsmith::sdp::testing {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Answer = CatalogueProblem::Answer;

/// Uniform numbers in [-1, 1), the same on every machine.
class Random {
 public:
  explicit Random(std::uint64_t seed) : stream_(seed, 0) {}
  double number() { return 2 * stream_.uniform() - 1; }
  MatrixXd matrix(int rows, int columns) {
    MatrixXd result(rows, columns);
    for (int j = 0; j < columns; ++j)
      for (int i = 0; i < rows; ++i) result(i, j) = number();
    return result;
  }
  MatrixXd symmetric(int n) {
    const MatrixXd a = matrix(n, n);
    return a + a.transpose();
  }
  MatrixXd orthogonal(int n) { return matrix(n, n).householderQr().householderQ(); }

 private:
  RandomStream stream_;
};

/// Appends the upper triangle of `matrix`, nonzeros only, as entries of one block.
void put(std::vector<Entry>& list, int block, const MatrixXd& matrix) {
  for (int j = 0; j < matrix.cols(); ++j)
    for (int i = 0; i <= j; ++i)
      if (matrix(i, j) != 0) list.push_back({block, i, j, matrix(i, j)});
}

Problem empty(std::vector<Block> blocks, int m) {
  Problem problem;
  problem.blocks = std::move(blocks);
  problem.c.assign(static_cast<std::size_t>(m), 0.0);
  problem.f.resize(static_cast<std::size_t>(m) + 1);
  return problem;
}

std::size_t at(int i) { return static_cast<std::size_t>(i); }

double trace_product(const MatrixXd& a, const MatrixXd& b) { return a.cwiseProduct(b).sum(); }

/// X = Q diag(lambda, 0) Q', Y = Q diag(0, omega) Q': optimal for F_0 = sum x_i F_i - X, c_i =
/// F_i.Y. `gap` eigenvectors belong to neither: no strict complementarity when it is positive.
CatalogueProblem planted(const std::string& name, int m, int n, int rank, int gap, double spread,
                         std::uint64_t seed) {
  Random random(seed);
  const MatrixXd q = random.orthogonal(n);
  VectorXd lambda = VectorXd::Zero(n), omega = VectorXd::Zero(n);
  for (int i = 0; i < rank; ++i) lambda[i] = 1.5 + random.number();
  for (int i = rank + gap; i < n; ++i) omega[i] = 1.5 + random.number();
  const MatrixXd X = q * lambda.asDiagonal() * q.transpose();
  const MatrixXd Y = q * omega.asDiagonal() * q.transpose();

  CatalogueProblem result{name, empty({{n, false}}, m)};
  MatrixXd f0 = -X;
  for (int i = 0; i < m; ++i) {
    const MatrixXd f = std::pow(10.0, spread * random.number()) * random.symmetric(n);
    const double x = random.number() / f.norm();
    result.problem.c[at(i)] = trace_product(f, Y);
    result.optimum += result.problem.c[at(i)] * x;
    f0 += x * f;
    put(result.problem.f[at(i) + 1], 0, f);
  }
  put(result.problem.f[0], 0, 0.5 * (f0 + f0.transpose()));
  return result;
}

/// The basis matrices of symmetric P, in the order of the upper triangle by columns.
std::vector<MatrixXd> symmetric_basis(int n) {
  std::vector<MatrixXd> result;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i <= j; ++i) {
      MatrixXd e = MatrixXd::Zero(n, n);
      e(i, j) = e(j, i) = 1;
      result.push_back(e);
    }
  return result;
}

MatrixXd stable(Random& random, int n) {
  const MatrixXd a = random.matrix(n, n);
  const double abscissa = a.eigenvalues().real().maxCoeff();
  return a - (abscissa + 0.5) * MatrixXd::Identity(n, n);
}

/// A'P + P A + Q = 0, by Kronecker products.
MatrixXd solve_lyapunov(const MatrixXd& a, const MatrixXd& q) {
  const Eigen::Index n = a.rows();
  MatrixXd k = MatrixXd::Zero(n * n, n * n);
  for (Eigen::Index j = 0; j < n; ++j)
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index l = 0; l < n; ++l) {
        k(i + n * j, l + n * j) += a(l, i);
        k(i + n * j, i + n * l) += a(l, j);
      }
  const VectorXd p = k.partialPivLu().solve(-q.reshaped());
  return p.reshaped(n, n);
}

/// min trace(P) s.t. -(A'P + P A) - Q >= 0: the Lyapunov solution.
CatalogueProblem lyapunov(int n, std::uint64_t seed) {
  Random random(seed);
  const MatrixXd a = stable(random, n);
  const MatrixXd q = MatrixXd::Identity(n, n);
  const auto basis = symmetric_basis(n);
  CatalogueProblem result{"lyapunov", empty({{n, false}}, static_cast<int>(basis.size()))};
  put(result.problem.f[0], 0, q);
  for (std::size_t i = 0; i < basis.size(); ++i) {
    result.problem.c[i] = basis[i].trace();
    put(result.problem.f[i + 1], 0, -(a.transpose() * basis[i] + basis[i] * a));
  }
  result.optimum = solve_lyapunov(a, q).trace();
  return result;
}

/// ||C (sI - A)^-1 B||_inf by bisection on the imaginary eigenvalues of the Hamiltonian matrix
/// (Boyd, Balakrishnan, Kabamba 1989).
double h_infinity_norm(const MatrixXd& a, const MatrixXd& b, const MatrixXd& c) {
  const Eigen::Index n = a.rows();
  double low = 0, high = 1e4;
  for (int step = 0; step < 200; ++step) {
    const double gamma = 0.5 * (low + high);
    MatrixXd h(2 * n, 2 * n);
    h << a, b * b.transpose() / (gamma * gamma), -c.transpose() * c, -a.transpose();
    const Eigen::VectorXcd lambda = h.eigenvalues();
    bool imaginary = false;
    for (const std::complex<double>& l : lambda)
      imaginary = imaginary || std::abs(l.real()) < 1e-9 * (1 + std::abs(l));
    (imaginary ? low : high) = gamma;
  }
  return high;
}

/// min g s.t. -[A'P + P A + C'C, P B; B'P, -g I] >= 0: g = ||C (sI - A)^-1 B||_inf^2.
CatalogueProblem bounded_real(std::uint64_t seed) {
  constexpr int n = 3, inputs = 2, outputs = 1;
  Random random(seed);
  const MatrixXd a = stable(random, n), b = random.matrix(n, inputs), c = random.matrix(outputs, n);
  const auto basis = symmetric_basis(n);
  const int m = static_cast<int>(basis.size()) + 1;
  CatalogueProblem result{"bounded-real", empty({{n + inputs, false}}, m)};
  MatrixXd f0 = MatrixXd::Zero(n + inputs, n + inputs);
  f0.topLeftCorner(n, n) = c.transpose() * c;
  put(result.problem.f[0], 0, f0);
  for (std::size_t i = 0; i < basis.size(); ++i) {
    MatrixXd f = MatrixXd::Zero(n + inputs, n + inputs);
    f.topLeftCorner(n, n) = -(a.transpose() * basis[i] + basis[i] * a);
    f.topRightCorner(n, inputs) = -basis[i] * b;
    put(result.problem.f[i + 1], 0, f);
  }
  MatrixXd g = MatrixXd::Zero(n + inputs, n + inputs);
  g.bottomRightCorner(inputs, inputs).setIdentity();
  put(result.problem.f.back(), 0, g);
  result.problem.c.back() = 1;
  const double norm = h_infinity_norm(a, b, c);
  result.optimum = norm * norm;
  result.digits = 6;  // what the eigenvalue oracle gives
  return result;
}

/// Is there P > 0 with [A'P + P A + C'C, P B; B'P, -g I] <= 0 at g = (norm (1 + excess))^2? Just,
/// or just not.
CatalogueProblem bounded_real_at(const std::string& name, double excess, std::uint64_t seed) {
  CatalogueProblem result = bounded_real(seed);
  const double g = result.optimum * (1 + excess) * (1 + excess);
  for (Entry e : result.problem.f.back()) {
    e.value *= -g;
    result.problem.f[0].push_back(e);
  }
  result.problem.f.pop_back();
  result.problem.c.assign(result.problem.f.size() - 1, 0.0);
  result.name = name;
  result.answer = excess > 0 ? Answer::optimum : Answer::primal_infeasible;
  result.optimum = 0;
  return result;
}

/// max trace(P) s.t. [A'P + P A + Q, P B; B'P, R] >= 0: the stabilising Riccati solution, here by
/// Newton's method (Kleinman 1968) from K = 0, A being stable. Its trace is the squared H2 norm of
/// the optimally controlled system with unit disturbances.
CatalogueProblem riccati(std::uint64_t seed) {
  constexpr int n = 3, inputs = 1;
  Random random(seed);
  const MatrixXd a = stable(random, n), b = random.matrix(n, inputs);
  const MatrixXd q = MatrixXd::Identity(n, n);
  MatrixXd p = MatrixXd::Zero(n, n), k = MatrixXd::Zero(inputs, n);
  for (int step = 0; step < 30; ++step) {
    p = solve_lyapunov(a - b * k, q + k.transpose() * k);
    k = b.transpose() * p;
  }
  const auto basis = symmetric_basis(n);
  CatalogueProblem result{"riccati", empty({{n + inputs, false}}, static_cast<int>(basis.size()))};
  MatrixXd f0 = MatrixXd::Zero(n + inputs, n + inputs);
  f0.topLeftCorner(n, n) = -q;
  f0.bottomRightCorner(inputs, inputs) = -MatrixXd::Identity(inputs, inputs);
  put(result.problem.f[0], 0, f0);
  for (std::size_t i = 0; i < basis.size(); ++i) {
    MatrixXd f = MatrixXd::Zero(n + inputs, n + inputs);
    f.topLeftCorner(n, n) = a.transpose() * basis[i] + basis[i] * a;
    f.topRightCorner(n, inputs) = basis[i] * b;
    put(result.problem.f[i + 1], 0, f);
    result.problem.c[i] = -basis[i].trace();
  }
  result.optimum = -p.trace();
  return result;
}

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

/// trace(F_i) = 0 and F_0 = I/n: Y = I has F_0.Y = 1.
CatalogueProblem infeasible_primal(std::uint64_t seed) {
  constexpr int m = 5, n = 6;
  Random random(seed);
  CatalogueProblem result{"primal infeasible", empty({{n, false}}, m), Answer::primal_infeasible};
  put(result.problem.f[0], 0, MatrixXd::Identity(n, n) / n);
  for (int i = 0; i < m; ++i) {
    MatrixXd f = random.symmetric(n);
    f.diagonal().array() -= f.trace() / n;
    put(result.problem.f[at(i) + 1], 0, f);
    result.problem.c[at(i)] = random.number();
  }
  return result;
}

/// F_1 > 0 with c_1 < 0: x = e_1 descends for ever.
CatalogueProblem infeasible_dual(std::uint64_t seed) {
  constexpr int m = 4, n = 5;
  Random random(seed);
  CatalogueProblem result{"dual infeasible", empty({{n, false}}, m), Answer::dual_infeasible};
  put(result.problem.f[0], 0, random.symmetric(n));
  for (int i = 0; i < m; ++i) {
    const MatrixXd a = random.matrix(n, n);
    put(result.problem.f[at(i) + 1], 0, i == 0 ? MatrixXd(a * a.transpose()) : random.symmetric(n));
    result.problem.c[at(i)] = i == 0 ? -1 : random.number();
  }
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

/// min x s.t. x - 2 >= 0, in a dense block of size one.
CatalogueProblem one_number() {
  CatalogueProblem result{"one number", empty({{1, false}}, 1)};
  result.problem.c = {1};
  result.problem.f[0] = {{0, 0, 0, 2}};
  result.problem.f[1] = {{0, 0, 0, 1}};
  result.optimum = 2;
  return result;
}

/// One F_i once more, doubled, at the doubled cost; and an F_i = 0 that costs nothing.
CatalogueProblem redundant(std::uint64_t seed) {
  CatalogueProblem result = planted("redundant and empty F_i", 4, 5, 2, 0, 0, seed);
  auto doubled = result.problem.f[2];
  for (Entry& e : doubled) e.value *= 2;
  result.problem.f.push_back(doubled);
  result.problem.c.push_back(2 * result.problem.c[1]);
  result.problem.f.emplace_back();
  result.problem.c.push_back(0);
  return result;
}

/// An F_i = 0 that pays for itself.
CatalogueProblem free_descent(std::uint64_t seed) {
  CatalogueProblem result = planted("empty F_i with a cost", 3, 4, 2, 0, 0, seed);
  result.answer = Answer::dual_infeasible;
  result.problem.f.emplace_back();
  result.problem.c.push_back(0.5);
  return result;
}

/// A dependent F_i with an inconsistent cost: x along the difference descends for ever.
CatalogueProblem inconsistent(std::uint64_t seed) {
  CatalogueProblem result = planted("dependent F_i, inconsistent cost", 3, 4, 2, 0, 0, seed);
  result.answer = Answer::dual_infeasible;
  result.problem.f.push_back(result.problem.f[1]);
  result.problem.c.push_back(result.problem.c[0] + 0.5);
  return result;
}

/// min x + y with x >= 1, y >= 1 - x/2 and x - 1 pinned to 0 by two inequalities: no interior.
CatalogueProblem no_interior() {
  CatalogueProblem result{"no interior", empty({{2, false}, {2, true}}, 2)};
  result.problem.c = {1, 1};
  result.problem.f[0] = {{0, 0, 1, -1}, {1, 0, 0, 1}, {1, 1, 1, -1}};
  result.problem.f[1] = {{0, 0, 0, 1}, {1, 0, 0, 1}, {1, 1, 1, -1}};
  result.problem.f[2] = {{0, 1, 1, 1}};
  result.optimum = 2;  // [x, 1; 1, y] >= 0 with x = 1: y = 1
  return result;
}

}  // namespace

std::vector<CatalogueProblem> sdp_catalogue() {
  return {planted("planted, strict", 6, 6, 3, 0, 0, 11),
          planted("planted, not strict", 6, 6, 2, 1, 0, 12),
          planted("planted, badly scaled", 8, 6, 3, 0, 4, 13),
          lyapunov(4, 14),
          bounded_real(15),
          bounded_real_at("bounded-real, just feasible", 1e-5, 15),
          bounded_real_at("bounded-real, just infeasible", -1e-5, 15),
          riccati(16),
          max_cut(5),
          infeasible_primal(17),
          infeasible_dual(18),
          weakly_infeasible(),
          not_attained(),
          linear_program(),
          one_number(),
          redundant(19),
          free_descent(20),
          inconsistent(21),
          no_interior()};
}

}  // namespace gainsmith::sdp::testing
