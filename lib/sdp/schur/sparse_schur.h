// A Schur complement that is mostly zero: compressed storage and sparse Cholesky.
#pragma once

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <vector>

#include "sdp/core/data.h"
#include "sdp/schur/linalg.h"

namespace gainsmith::sdp {

/// B_ij can differ from zero only where some block holds both F_i and F_j. Where that is a small
/// part of the matrix, B lives in compressed columns (lower triangle) and is factored with a
/// fill-reducing order (AMD), found once.
template <typename T>
class SparseSchur {
 public:
  explicit SparseSchur(const Data& data);

  /// Is the pattern sparse enough? If not, nothing is stored and nothing else may be called.
  bool worthwhile() const { return worthwhile_; }

  void set_zero();
  /// B_ij += value, i >= j; the place must be in the pattern. Different places may be added to at
  /// once.
  void add(int i, int j, const T& value);
  T diagonal(int i) const { return b_.valuePtr()[b_.outerIndexPtr()[i]]; }
  /// Cholesky of S B S + delta I, S the diagonal matrix `scale` with S B S having ones there.
  bool factorise(const Vector<T>& scale, const T& delta);
  /// x := (S B S + delta I)^-1 x
  void solve(Vector<T>& x) const { x = llt_.solve(x).eval(); }

 private:
  using Sparse = Eigen::SparseMatrix<T>;
  /// Makes the pattern, where columns[j] are the rows i >= j of column j, increasing.
  void build(const std::vector<std::vector<int>>& columns);

  bool worthwhile_ = false;
  Sparse b_, scaled_;
  Eigen::SimplicialLLT<Sparse, Eigen::Lower> llt_;
};

}  // namespace gainsmith::sdp
