// The finite zeros of (A, B, C, D): the pencil [A - s I, B; C, D] is reduced to one with the same
// finite zeros and D square and invertible (Emami-Naeini & Van Dooren 1982). Its zeros are
//   eig(A - B D^-1 C).
#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <limits>
#include <utility>

#include "numerics/balance.h"
#include "response/state_space.h"

namespace gainsmith::response {

namespace {

/// Of M the rank, and an orthogonal U with U' M = [rows of that rank; 0].
struct Rows {
  Eigen::Index rank = 0;
  Matrix U;
};

Rows compressed_rows(const Matrix& M, double tolerance) {
  if (M.rows() == 0 || M.cols() == 0) return {0, Matrix::Identity(M.rows(), M.rows())};
  const Eigen::JacobiSVD<Matrix> svd(M, Eigen::ComputeFullU);
  Rows rows{0, svd.matrixU()};
  for (const double value : svd.singularValues())
    if (value > tolerance) ++rows.rank;
  return rows;
}

/// [A, B; C, D] with the same finite zeros and D of full row rank. U'[C, D] = [C1, D1; C2, 0]: at a
/// zero C2 x = 0. In an orthogonal basis x = V [s; r], in which C2 sees s alone, s = 0 leaves
///   r' = A_rr r + B_r u,   outputs  A_sr r + B_s u  and  C1_r r + D1 u.
/// This is repeated; each time there are fewer states, or D has full row rank.
StateSpace reduced(StateSpace system, double tolerance) {
  for (;;) {
    const Rows of_d = compressed_rows(system.D, tolerance);
    const Eigen::Index p = system.outputs(), rank = of_d.rank;
    if (rank == p) return system;
    const Matrix C = of_d.U.transpose() * system.C, D = of_d.U.transpose() * system.D;
    const Matrix below = C.bottomRows(p - rank);
    // The states that the outputs without direct gain see.
    const Rows seen = compressed_rows(below.transpose(), tolerance);
    const Eigen::Index r = seen.rank, n = system.states();
    StateSpace next;
    next.step = system.step;
    if (r == 0) {
      next.A = system.A;
      next.B = system.B;
      next.C = C.topRows(rank);
      next.D = D.topRows(rank);
      return next;
    }
    // x = V [seen; rest]: the seen ones are 0, and so are their rates, which are outputs now.
    const Matrix& V = seen.U;
    const Matrix A = V.transpose() * system.A * V, B = V.transpose() * system.B, Cv = C * V;
    const Eigen::Index rest = n - r, m = system.inputs();
    next.A = A.bottomRightCorner(rest, rest);
    next.B = B.bottomRows(rest);
    next.C.resize(r + rank, rest);
    next.C << A.topRightCorner(r, rest), Cv.topRightCorner(rank, rest);
    next.D.resize(r + rank, m);
    next.D << B.topRows(r), D.topRows(rank);
    system = std::move(next);
  }
}

StateSpace transposed(const StateSpace& system) {
  return {system.A.transpose(), system.C.transpose(), system.B.transpose(), system.D.transpose(),
          system.step};
}

StateSpace balanced(const StateSpace& system) {
  StateSpace result = in_units(system, numerics::units(system.A.cwiseAbs(), system.C.cwiseAbs()));
  // In these units of the inputs and outputs B and C have the Frobenius norm 1.
  const auto size_of = [](const Matrix& M) { return M.norm() > 0 ? M.norm() : 1.0; };
  const double inputs = size_of(result.B), outputs = size_of(result.C);
  result.B /= inputs;
  result.C /= outputs;
  result.D /= inputs * outputs;
  return result;
}

}  // namespace

Matrix zeros(const StateSpace& system) {
  const Eigen::Index n = system.states();
  if (n == 0 || system.inputs() == 0 || system.outputs() == 0) return Matrix(0, 2);
  // In a unit of time in which A is near 1.
  StateSpace slow = system;
  const double speed = system.A.norm() > 0 ? system.A.norm() : 1;
  slow.A /= speed;
  slow.B /= speed;
  const StateSpace start = balanced(slow);
  Matrix whole(n + start.outputs(), n + start.inputs());
  whole << start.A, start.B, start.C, start.D;
  constexpr double kRoundings = 100;
  const double tolerance = kRoundings * std::numeric_limits<double>::epsilon() * whole.norm();
  // First D of full row rank, then of full column rank: it is square and invertible.
  const StateSpace small = transposed(reduced(transposed(reduced(start, tolerance)), tolerance));
  const Eigen::Index k = small.states();
  if (k == 0 || small.inputs() != small.outputs()) return Matrix(0, 2);
  const Matrix pencil = small.inputs() == 0
                            ? small.A
                            : Matrix(small.A - small.B * small.D.fullPivLu().solve(small.C));
  const Eigen::EigenSolver<Matrix> solver(pencil, false);
  Matrix found(k, 2);
  for (Eigen::Index i = 0; i < k; ++i)
    found.row(i) << solver.eigenvalues()(i).real(), solver.eigenvalues()(i).imag();
  return found * speed;
}

}  // namespace gainsmith::response
