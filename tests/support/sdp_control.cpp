// Linear matrix inequalities of control, whose answers other algorithms give.
#include <complex>

#include "support/sdp_build.h"

namespace gainsmith::sdp::testing {
namespace {

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
  const double abscissa = tests::spectral_abscissa(a);
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
  const VectorXd p = tests::solve(k, -q.reshaped());
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
    const Eigen::VectorXcd lambda = tests::eigenvalues(h);
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

}  // namespace

std::vector<CatalogueProblem> control_problems() {
  return {lyapunov(4, 14), bounded_real(15),
          bounded_real_at("bounded-real, just feasible", 1e-5, 15),
          bounded_real_at("bounded-real, just infeasible", -1e-5, 15), riccati(16)};
}

}  // namespace gainsmith::sdp::testing
