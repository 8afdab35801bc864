#include "properties/programs.h"

#include <algorithm>
#include <cmath>

#include "sdp/solver.h"

namespace gainsmith::tests::properties {

namespace {

struct Whole {
  ExactMatrix U;
  ExactMatrix inverse;
};

Whole unimodular(Draw& draw, int n) {
  Whole result{ExactMatrix::identity(n), ExactMatrix::identity(n)};
  for (int k = 0; k < n; ++k) {
    const int i = draw.below(n);
    const int j = (i + 1 + draw.below(n - 1)) % n;
    const Exact factor = draw.chance(0.5) ? 1 : -1;
    ExactMatrix S = ExactMatrix::identity(n);
    S(i, j) = factor;
    result.U = result.U * S;
    S(i, j) = -factor;
    result.inverse = S * result.inverse;
  }
  return result;
}

/// M diag(d) M' with d from 1 to 5 in [first, last), 0 elsewhere.
ExactMatrix semidefinite(Draw& draw, const ExactMatrix& M, int first, int last) {
  std::vector<Exact> d(static_cast<std::size_t>(M.rows()));
  for (int i = first; i < last; ++i) d[static_cast<std::size_t>(i)] = draw.between(1, 5);
  return M * ExactMatrix::diagonal(d) * M.transpose();
}

void put(const ExactMatrix& F, std::vector<sdp::Entry>& list) {
  for (int i = 0; i < F.rows(); ++i)
    for (int j = i; j < F.columns(); ++j)
      if (F(i, j) != 0) list.push_back({0, i, j, F(i, j).convert_to<double>(), 0});
}

Program assembled(const std::vector<ExactMatrix>& F, const std::vector<Exact>& c) {
  Program result;
  result.problem.blocks = {{F[0].rows(), false}};
  result.problem.f.resize(F.size());
  for (std::size_t i = 0; i < F.size(); ++i) put(F[i], result.problem.f[i]);
  for (const Exact& cost : c) result.problem.c.push_back(cost.convert_to<double>());
  return result;
}

Program with_optimum(Draw& draw, int n, int m) {
  const Whole to = unimodular(draw, n);
  const int rank = draw.between(1, n - 1);
  const ExactMatrix X = semidefinite(draw, to.U, 0, rank);
  const ExactMatrix Y = semidefinite(draw, to.inverse.transpose(), rank, n);
  std::vector<ExactMatrix> F{Exact(-1) * X};
  std::vector<Exact> c;
  Exact optimum = 0;
  for (int i = 0; i < m; ++i) {
    F.push_back(i == 0 ? semidefinite(draw, to.U, 0, n) : symmetric(draw, n));
    const Exact x = draw.between(-3, 3);
    F[0] = F[0] + x * F.back();
    c.push_back(trace_product(F.back(), Y));
    optimum += x * c.back();
  }
  Program result = assembled(F, c);
  result.optimum = optimum.convert_to<double>();
  return result;
}

Program without_primal(Draw& draw, int n, int m) {
  const Whole to = unimodular(draw, n);
  const int rank = draw.between(0, n - 1);
  const ExactMatrix Y = semidefinite(draw, to.inverse.transpose(), rank, n);
  // E.Y = k, so k F - (F.Y) E has no product with Y.
  const ExactMatrix E = ExactMatrix::identity(n);
  const Exact k = trace_product(E, Y);
  std::vector<ExactMatrix> F{E};
  std::vector<Exact> c;
  for (int i = 0; i < m; ++i) {
    const ExactMatrix drawn = symmetric(draw, n);
    F.push_back(k * drawn + Exact(-trace_product(drawn, Y)) * E);
    F[0] = F[0] + Exact(draw.between(-3, 3)) * F.back();
    c.push_back(draw.between(-5, 5));
  }
  Program result = assembled(F, c);
  result.truth = Program::Truth::primal_infeasible;
  return result;
}

Program without_dual(Draw& draw, int n, int m) {
  const Whole to = unimodular(draw, n);
  ExactMatrix last = semidefinite(draw, to.U, 0, draw.between(1, n));
  std::vector<ExactMatrix> F{symmetric(draw, n)};
  std::vector<Exact> c;
  Exact cost = -draw.between(1, 9);
  for (int i = 0; i + 1 < m; ++i) {
    F.push_back(symmetric(draw, n));
    const Exact x = draw.between(-3, 3);
    last = last + Exact(-x) * F.back();
    c.push_back(draw.between(-5, 5));
    cost -= x * c.back();
  }
  F.push_back(last);
  c.push_back(cost);
  Program result = assembled(F, c);
  result.truth = Program::Truth::dual_infeasible;
  return result;
}

/// Whether the status is a lie. Both sides may lack solutions: the other side's certificate is then
/// as true, so for planted certificates only "optimal" is.
bool is_wrong(const Program& known, const sdp::Solution& found) {
  using sdp::Status;
  if (known.truth != Program::Truth::optimum) return found.status == Status::optimal;
  if (found.status == Status::undecided) return false;
  if (found.status != Status::optimal) return true;
  const double near = 1e-6 * std::max(1.0, std::abs(known.optimum));
  return !(std::abs(found.primal_objective - known.optimum) <= near);
}

}  // namespace

Program make_program(std::uint64_t seed, std::uint64_t index) {
  Draw draw(seed, index);
  const int n = draw.between(2, 7);
  const int m = draw.between(1, std::min(6, n * (n + 1) / 2 - 1));
  switch (draw.below(4)) {
    case 0:
      return without_primal(draw, n, m);
    case 1:
      return without_dual(draw, n, m);
    default:
      return with_optimum(draw, n, m);
  }
}

Answer judge(const Program& known) {
  const sdp::Solution found = sdp::solve(known.problem);
  Answer answer;
  answer.message = sdp::to_string(found.status) + ": " + found.message;
  answer.seconds = found.seconds;
  answer.outcome = is_wrong(known, found)                   ? Outcome::wrong
                   : found.status == sdp::Status::undecided ? Outcome::undecided
                                                            : Outcome::right;
  return answer;
}

}  // namespace gainsmith::tests::properties
