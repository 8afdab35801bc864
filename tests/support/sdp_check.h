// The DIMACS errors and certificates once more, from the raw problem, by code that shares nothing
// with the solver: plain loops in long double.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "sdp/problem.h"
#include "sdp/solution.h"

namespace gainsmith::sdp::testing {

using Real = long double;
using Square = std::vector<Real>;  ///< column-major

/// A full symmetric matrix a block from packed values plus, where given, their rests.
inline std::vector<Square> unpack(const Problem& problem, const BlockMatrix& matrix,
                                  const BlockMatrix& rest) {
  std::vector<Square> result;
  for (std::size_t b = 0; b < problem.blocks.size(); ++b) {
    const auto n = static_cast<std::size_t>(problem.blocks[b].size);
    Square& s = result.emplace_back(n * n, 0.0L);
    for (std::size_t k = 0; k < matrix.values[b].size(); ++k) {
      const std::size_t place = problem.blocks[b].diagonal ? k * (n + 1) : k;
      s[place] = matrix.values[b][k];
      if (!rest.values.empty()) s[place] += rest.values[b][k];
    }
  }
  return result;
}

inline Real inner(const Problem& problem, const std::vector<Entry>& f,
                  const std::vector<Square>& s) {
  Real sum = 0;
  for (const Entry& e : f) {
    const auto n = static_cast<std::size_t>(problem.blocks[static_cast<std::size_t>(e.block)].size);
    const auto i = static_cast<std::size_t>(e.row), j = static_cast<std::size_t>(e.column);
    const Square& block = s[static_cast<std::size_t>(e.block)];
    const Real value = static_cast<Real>(e.value) + e.rest;
    sum += value * (i == j ? block[i + n * i] : block[i + n * j] + block[j + n * i]);
  }
  return sum;
}

/// sum x_i F_i - tau F_0
inline std::vector<Square> combine(const Problem& problem, const std::vector<Real>& x, Real tau) {
  std::vector<Square> result;
  for (const Block& block : problem.blocks)
    result.emplace_back(static_cast<std::size_t>(block.size) * static_cast<std::size_t>(block.size),
                        0.0L);
  for (std::size_t k = 0; k < problem.f.size(); ++k)
    for (const Entry& e : problem.f[k]) {
      const auto n =
          static_cast<std::size_t>(problem.blocks[static_cast<std::size_t>(e.block)].size);
      const auto i = static_cast<std::size_t>(e.row), j = static_cast<std::size_t>(e.column);
      const Real value = (k == 0 ? -tau : x[k - 1]) * (static_cast<Real>(e.value) + e.rest);
      Square& block = result[static_cast<std::size_t>(e.block)];
      block[i + n * j] += value;
      if (i != j) block[j + n * i] += value;
    }
  return result;
}

/// Is s + shift I positive definite? By elimination.
inline bool positive(const Square& s, std::size_t n, Real shift) {
  Square a = s;
  for (std::size_t i = 0; i < n; ++i) a[i + n * i] += shift;
  for (std::size_t k = 0; k < n; ++k) {
    if (!(a[k + n * k] > 0)) return false;
    for (std::size_t j = k + 1; j < n; ++j)
      for (std::size_t i = k + 1; i < n; ++i)
        a[i + n * j] -= a[i + n * k] * a[k + n * j] / a[k + n * k];
  }
  return true;
}

inline bool positive(const std::vector<Square>& s, Real shift) {
  for (const Square& block : s) {
    const auto n =
        static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(block.size()))));
    if (!positive(block, n, shift)) return false;
  }
  return true;
}

struct Errors {
  Real primal_objective = 0, dual_objective = 0;
  Real dual = 0, primal = 0, gap = 0, complementarity = 0;  ///< DIMACS 1, 3, 5, 6
  bool cone = false;                                        ///< DIMACS 2 and 4 below the tolerance
  /// What rounding here may add to `primal`: where F_i are dependent, some x cancel each other.
  Real rounding = 0;
};

inline Errors recompute(const Problem& problem, const Solution& solution, Real tolerance) {
  Errors errors;
  std::vector<Real> x(solution.x.begin(), solution.x.end());
  for (std::size_t i = 0; i < solution.rest.x.size(); ++i) x[i] += solution.rest.x[i];
  const auto X = unpack(problem, solution.X, solution.rest.X);
  const auto Y = unpack(problem, solution.Y, solution.rest.Y);
  Real largest_c = 0, largest_f0 = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Real c = problem.c[i] + (problem.c_rest.empty() ? 0.0L : problem.c_rest[i]);
    largest_c = std::max(largest_c, std::abs(c));
    errors.primal_objective += c * x[i];
    const Real r = inner(problem, problem.f[i + 1], Y) - c;
    errors.dual += r * r;
    for (const Entry& e : problem.f[i + 1])
      errors.rounding += 4 * std::numeric_limits<Real>::epsilon() * std::abs(x[i] * e.value);
  }
  for (const Entry& e : problem.f[0]) largest_f0 = std::max<Real>(largest_f0, std::abs(e.value));
  errors.dual_objective = inner(problem, problem.f[0], Y);
  const auto combined = combine(problem, x, 1);
  for (std::size_t b = 0; b < X.size(); ++b)
    for (std::size_t k = 0; k < X[b].size(); ++k) {
      const Real r = combined[b][k] - X[b][k];
      errors.primal += r * r;
      errors.complementarity += X[b][k] * Y[b][k];
    }
  const Real size = 1 + std::abs(errors.primal_objective) + std::abs(errors.dual_objective);
  errors.dual = std::sqrt(errors.dual) / (1 + largest_c);
  errors.primal = std::sqrt(errors.primal) / (1 + largest_f0);
  errors.rounding /= 1 + largest_f0;
  errors.gap = (errors.primal_objective - errors.dual_objective) / size;
  errors.complementarity /= size;
  errors.cone =
      positive(X, tolerance * (1 + largest_f0)) && positive(Y, tolerance * (1 + largest_c));
  return errors;
}

}  // namespace gainsmith::sdp::testing
