// Internal to numbers: spectrum.h, instantiated by one source for double and one for more digits.
#pragma once

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/stop.h"
#include "numbers/dense/riccati_rules.h"
#include "numbers/dense/spectrum.h"
#include "numbers/types/ball.h"
#include "numerics/balance.h"
#include "numerics/working.h"

namespace gainsmith::numbers {

/// From the blocks on the diagonal of the real Schur form M = U T U', of one row or two: those of
/// [a, b; c, d] are d + p +- i sqrt(-(p^2 + b c)) with p = (a - d)/2. Eigen splits blocks whose
/// eigenvalues are real.
template <class W>
std::vector<Eigenvalue<W>> eigenvalues(const MatrixOf<W>& M) {
  using std::sqrt;
  if (M.size() == 0) return {};
  check_stop();
  const Eigen::RealSchur<MatrixOf<W>> schur(M, false);
  if (schur.info() != Eigen::Success) throw NoSolution("an eigenvalue is not found");
  const MatrixOf<W>& T = schur.matrixT();
  std::vector<Eigenvalue<W>> found;
  for (Eigen::Index i = 0; i < T.rows(); ++i) {
    if (i + 1 == T.rows() || T(i + 1, i) == W(0)) {
      found.push_back({T(i, i), W(0)});
      continue;
    }
    const W p = (T(i, i) - T(i + 1, i + 1)) / W(2);
    const W q = p * p + T(i, i + 1) * T(i + 1, i);
    const W root = sqrt(q < W(0) ? W(-q) : q);
    found.push_back({W(T(i + 1, i + 1) + p), root});
    found.push_back({W(T(i + 1, i + 1) + p), W(-root)});
    ++i;
  }
  return found;
}

/// In balanced units, with parts below 64 n roundings of |M| as 0.
template <class W>
std::vector<Eigenvalue<W>> balanced_eigenvalues(const MatrixOf<W>& M) {
  const auto scale = [](const W& x, int exponent) { return times_power_of_two(x, exponent); };
  const std::vector<int> units =
      numerics::balance(M.unaryExpr([](const W& x) { return std::abs(static_cast<double>(x)); }));
  const MatrixOf<W> B = numerics::in_units(M, units, scale);
  std::vector<Eigenvalue<W>> found = eigenvalues<W>(B);
  constexpr double kRoundings = 64;
  const W nothing = W(kRoundings * static_cast<double>(M.rows())) *
                    std::numeric_limits<W>::epsilon() * (M.size() == 0 ? W(0) : norm_1<W>(B));
  for (Eigenvalue<W>& eigenvalue : found)
    for (W* part : {&eigenvalue.real, &eigenvalue.imaginary})
      if (*part <= nothing && -*part <= nothing) *part = W(0);
  return found;
}

/// Sorted after rounding: real parts that are equal then count as equal.
template <class Scalar>
MatrixOf<Scalar> real_eigenvalues(const MatrixOf<Scalar>& M) {
  using W = numerics::Working<Scalar>;
  std::vector<Eigenvalue<Scalar>> all;
  for (const Eigenvalue<W>& eigenvalue : balanced_eigenvalues<W>(numerics::widened<Scalar>(M)))
    all.push_back({as<Scalar>(eigenvalue.real), as<Scalar>(eigenvalue.imaginary)});
  const auto size = [](const Scalar& x) { return x < Scalar(0) ? Scalar(-x) : x; };
  std::ranges::sort(all, [&](const auto& a, const auto& b) {
    if (a.real != b.real) return a.real > b.real;
    const Scalar left = size(a.imaginary), right = size(b.imaginary);
    return left != right ? left < right : a.imaginary > b.imaginary;
  });
  MatrixOf<Scalar> rows(M.rows(), 2);
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    rows(i, 0) = all[static_cast<std::size_t>(i)].real;
    rows(i, 1) = all[static_cast<std::size_t>(i)].imaginary;
  }
  return rows;
}

template <class Scalar>
MatrixOf<Scalar> stabilising_solution(Riccati equation, const MatrixOf<Scalar>& A,
                                      const MatrixOf<Scalar>& B, const MatrixOf<Scalar>& Q,
                                      const MatrixOf<Scalar>& R, const MatrixOf<Scalar>& S) {
  const auto wide = [](const MatrixOf<Scalar>& M) { return numerics::widened<Scalar>(M); };
  const RiccatiSolver<numerics::Working<Scalar>> solver(equation, wide(A), wide(B), wide(Q),
                                                        wide(R), wide(S));
  return numerics::narrowed<Scalar>(solver.solve(numerics::rounding<Scalar>()));
}

}  // namespace gainsmith::numbers
