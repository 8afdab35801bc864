// The Schur complement B of the Newton system: its assembly and its factor.
#pragma once

#include <utility>
#include <vector>

#include "sdp/core/data.h"
#include "sdp/core/view.h"
#include "sdp/schur/linalg.h"
#include "sdp/schur/panel.h"
#include "sdp/schur/sparse_schur.h"

namespace gainsmith::sdp {

/// B_ij = F_i . (X^-1 F_j Y), i, j = 1..m, symmetric positive definite when the F_i are independent
/// (Helmberg-Rendl-Vanderbei-Wolkowicz / Kojima-Shindoh-Hara / Monteiro direction). The linear part
/// adds sum_k F_i[k] F_j[k] y_k / x_k.
///
/// Within a dense block of n rows each F_i, in falling order of its nonzeros, takes the cheaper of
///   dense: U = X^-1 (F_i Y) by one matrix product for eight F_i at a time, then F_j . U for the
///          F_j that follow, eight at a time from an interleaved panel;
///   rank:  the same, with F_i = sum_{s in S} (e_s g_s' + g_s e_s'), S a few rows that cover its
///          entries (as in A'P + PA): U = sum X^-1 e_s (Y g_s)' + X^-1 g_s (Y e_s)', a product of
///          inner length 2 |S|;
///   rows:  with R the nonzero rows of F_i, (F_i Y)_R is formed and only the entries of
///          U = X^-1(:,R) (F_i Y)_R where F_j has one, as dot products of length |R|.
/// Both triangles' share comes from the symmetric part of U, so each pair is visited once.
template <typename T>
class Schur {
 public:
  explicit Schur(const Data& data, unsigned threads = 1);

  void assemble(const Blocks<T>& inverse_X, const Blocks<T>& Y);

  /// Cholesky of B + delta diag(B) with its diagonal scaled to one, delta = 16 epsilon in double
  /// and 0 in wider arithmetic; where that fails, with 8 times as much (8 epsilon after 0), again
  /// and again. False when no delta in reason succeeds.
  bool factorise();

  /// x = B^-1 r as the factor gives it; newton.h refines it.
  void solve(const Vector<T>& r, Vector<T>& x) const;

 private:
  static constexpr int kBatch = kLanes;
  enum class Formula { dense, rank, rows };
  /// A list of one block in the order of assembly.
  struct List {
    int constraint = 0;     ///< from 0
    std::size_t first = 0;  ///< its terms in Plan::packed / value
    std::size_t last = 0;
    Formula formula = Formula::dense;
    std::vector<int> rows;  ///< R by rows, S by rank
  };
  /// Lists first .. last - 1, of one formula, which are assembled together.
  struct Batch {
    std::size_t first = 0;
    std::size_t last = 0;
  };
  struct Plan {
    std::vector<List> lists;
    std::vector<Term> terms;  ///< regrouped in the order of `lists`
    std::vector<int> packed;  ///< place of a term in the packed upper triangle
    std::vector<T> value;     ///< of a term
    std::vector<int> slot;    ///< by rank: the place in S of the row that covers the term
    std::vector<Batch> batches;
    double cost = 0;  ///< in multiplications, about
  };
  struct Workspace {
    Vector<T> h;     ///< F_i Y, transposed: (n * kBatch) x n, or |R| x n
    Vector<T> u;     ///< X^-1 F_i Y
    Matrix<T> p, q;  ///< by rank: U = P Q'
    Panel<T> panel;  ///< U + U' (U on the diagonal), packed upper triangle
  };

  void add_batch(const Plan& plan, const Batch& batch, const ConstMatrixMap<T>& inverse_X,
                 const ConstMatrixMap<T>& Y, Workspace& w);
  void size_workspaces();
  Plan plan_block(const BlockData& block, int n) const;
  /// Appends list k of `block`.
  void append_list(const BlockData& block, std::size_t k, Plan& plan) const;
  /// Gives the last list of `plan` the cheapest formula, `following` being the terms of the lists
  /// from it on, and adds what that costs.
  void choose_formula(Plan& plan, double following, int n) const;
  void add_dense(const Plan& plan, std::size_t first, std::size_t last,
                 const ConstMatrixMap<T>& inverse_X, const ConstMatrixMap<T>& Y, Workspace& w);
  void multiply_lists(const Plan& plan, std::size_t first, std::size_t last,
                      const ConstMatrixMap<T>& inverse_X, const ConstMatrixMap<T>& Y,
                      Workspace& w) const;
  void multiply_by_rank(const Plan& plan, const List& list, const ConstMatrixMap<T>& inverse_X,
                        const ConstMatrixMap<T>& Y, Workspace& w, const View<T>& u) const;
  void add_rows(const Plan& plan, std::size_t position, const ConstMatrixMap<T>& inverse_X,
                const ConstMatrixMap<T>& Y, Workspace& w);
  void add_linear(const ConstVectorMap<T>& inverse_x, const ConstVectorMap<T>& y);
  void add(int i, int j, const T& value) {
    if (i < j) std::swap(i, j);
    if (sparse_.worthwhile())
      sparse_.add(i, j, value);
    else
      b_(i, j) += value;
  }
  /// Cholesky of the scaled B + delta I.
  bool factorise(const T& delta);

  const Data& data_;
  unsigned threads_;
  std::vector<Plan> plans_;
  std::vector<Workspace> work_;  ///< one a thread
  /// The linear part by column: the F_i that have the entry k.
  std::vector<std::vector<std::pair<int, T>>> columns_;
  SparseSchur<T> sparse_;
  Matrix<T> b_;       ///< lower triangle; empty when sparse
  Matrix<T> factor_;  ///< lower triangle of the Cholesky factor of the scaled B
  Vector<T> scale_;   ///< diag(B)^-1/2
};

}  // namespace gainsmith::sdp
