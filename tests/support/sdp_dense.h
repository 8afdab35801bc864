// The solver's equations by their definition, for the tests of its parts: every matrix stored in
// full, one a block and one of size one a linear entry, plain loops, nothing shared with the solver
// but the record `Data`.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "sdp/core/data.h"
#include "sdp/problem.h"

namespace gainsmith::sdp::testing {

template <typename T>
using Full = std::vector<Matrix<T>>;

template <typename T>
Full<T> full(const Blocks<T>& matrix);

/// a + factor b
template <typename T>
Full<T> plus(const Full<T>& a, const T& factor, const Full<T>& b);

template <typename T>
Full<T> times(const Full<T>& a, const Full<T>& b);

/// H(M) = (M + M')/2
template <typename T>
Full<T> symmetric_part(const Full<T>& m);

/// trace(A B)
template <typename T>
T trace_of_product(const Full<T>& a, const Full<T>& b);

/// By Gauss-Jordan elimination; for positive definite matrices, which need no pivoting.
template <typename T>
Full<T> inverse(const Full<T>& m);

template <typename T>
double largest(const Full<T>& m);

template <typename T>
double largest(const Vector<T>& v);

/// F_0, ..., F_m and c of a working problem, in full.
template <typename T>
struct Dense {
  explicit Dense(const Data& data);

  int m() const { return static_cast<int>(c.size()); }

  /// sum x_i F_i - tau F_0
  Full<T> combine(const Vector<T>& x, const T& tau) const;

  /// A(S)_i = F_i . S
  Vector<T> products(const Full<T>& s) const;

  std::vector<Full<T>> f;
  Vector<T> c;

 private:
  template <typename Visit>
  void visit(const BlockData& block, const Visit& at);
};

struct NamedProblem {
  std::string name;
  Problem problem;
};

/// Random F_i and c in every shape that blocks and coefficients come in: one dense block, a
/// diagonal one, blocks of size one, several with coefficients that are empty in some, rows that
/// never occur, coefficients of a few entries, of a few rows (as P A + A'P), and a chain of small
/// blocks whose Schur complement is sparse. All numbers have a rest.
std::vector<NamedProblem> random_problems(std::uint64_t seed);

/// A A' + I with random A in every block, 1 + a^2 in the linear part.
template <typename T>
void fill_positive(std::uint64_t seed, Blocks<T>& matrix);
/// Positive definite, with the pattern of `data` where a block keeps one: so are X and R.
template <typename T>
void fill_positive(std::uint64_t seed, const Data& data, Blocks<T>& matrix);
/// Random and symmetric.
template <typename T>
void fill_symmetric(std::uint64_t seed, Blocks<T>& matrix);
template <typename T>
void fill(std::uint64_t seed, Vector<T>& v);

}  // namespace gainsmith::sdp::testing
