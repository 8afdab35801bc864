#include "numbers/dense/rational_algebra.h"

#include <cstdint>

#include "base/stop.h"
#include "numbers/dense/residue.h"

namespace gainsmith::numbers {

namespace {

/// Row i minus M(i, first) times row r, from column `first` on, where M(r, first) = 1.
void subtract_row(RationalMatrix& M, Eigen::Index i, Eigen::Index r, Eigen::Index first) {
  check_stop();
  const Rational factor = M(i, first);
  for (Eigen::Index j = first; j < M.cols(); ++j)
    if (M(r, j) != 0) M(i, j) -= factor * M(r, j);
}

using Residues = Eigen::Matrix<std::uint64_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The elements modulo kPrime. None when the prime divides a denominator.
std::optional<Residues> residues_of(const RationalMatrix& M) {
  Residues result = Residues::Zero(M.rows(), M.cols());
  for (Eigen::Index i = 0; i < M.rows(); ++i)
    for (Eigen::Index j = 0; j < M.cols(); ++j) {
      if (M(i, j) == 0) continue;
      const auto residue = residue_of(M(i, j));
      if (!residue) return std::nullopt;
      result(i, j) = *residue;
    }
  return result;
}

}  // namespace

/// Gauss' elimination modulo p, in 64-bit arithmetic: a pivot in each column shows the rank. False
/// also where p divides a denominator, or a minor by chance.
bool are_surely_independent(const RationalMatrix& M) {
  if (M.rows() < M.cols()) return false;
  auto residues = residues_of(M);
  if (!residues) return false;
  Residues& R = *residues;
  for (Eigen::Index c = 0; c < R.cols(); ++c) {
    check_stop();
    Eigen::Index found = c;
    while (found < R.rows() && R(found, c) == 0) ++found;
    if (found == R.rows()) return false;
    if (found != c) R.row(found).swap(R.row(c));
    const std::uint64_t inverse = inverse_modulo(R(c, c));
    for (Eigen::Index i = found + 1; i < R.rows(); ++i) {
      if (R(i, c) == 0) continue;
      const std::uint64_t factor = kPrime - R(i, c) * inverse % kPrime;
      for (Eigen::Index j = c; j < R.cols(); ++j)
        if (R(c, j) != 0) R(i, j) = (R(i, j) + factor * R(c, j)) % kPrime;
    }
  }
  return true;
}

/// By outer products of columns and rows: a 0 of A saves a row of products.
RationalMatrix rational_product(const RationalMatrix& A, const RationalMatrix& B) {
  RationalMatrix result = RationalMatrix::Constant(A.rows(), B.cols(), Rational(0));
  for (Eigen::Index k = 0; k < A.cols(); ++k)
    for (Eigen::Index i = 0; i < A.rows(); ++i) {
      if (A(i, k) == 0) continue;
      for (Eigen::Index j = 0; j < B.cols(); ++j)
        if (B(k, j) != 0) result(i, j) += A(i, k) * B(k, j);
    }
  return result;
}

bool is_rational_zero(const RationalMatrix& M) {
  for (const Rational& x : M.reshaped())
    if (x != 0) return false;
  return true;
}

/// Gauss and Jordan. The first element other than 0 is the pivot: without rounding any is as good.
Echelon reduced_echelon(RationalMatrix M) {
  Echelon result;
  Eigen::Index r = 0;
  for (Eigen::Index c = 0; c < M.cols() && r < M.rows(); ++c) {
    Eigen::Index found = r;
    while (found < M.rows() && M(found, c) == 0) ++found;
    if (found == M.rows()) continue;
    if (found != r) M.row(found).swap(M.row(r));
    const Rational pivot = M(r, c);
    for (Eigen::Index j = c; j < M.cols(); ++j)
      if (M(r, j) != 0) M(r, j) /= pivot;
    for (Eigen::Index i = 0; i < M.rows(); ++i)
      if (i != r && M(i, c) != 0) subtract_row(M, i, r, c);
    result.pivots.push_back(c);
    ++r;
  }
  result.rows = M.topRows(r);
  return result;
}

/// For each column j without a pivot the x with x_j = 1, x_p(r) = -E_rj for the pivots p(r) of the
/// echelon form E, and 0 elsewhere: n - rank columns.
RationalMatrix rational_kernel(const RationalMatrix& M) {
  const Echelon echelon = reduced_echelon(M);
  const auto rank = static_cast<Eigen::Index>(echelon.pivots.size());
  RationalMatrix result = RationalMatrix::Constant(M.cols(), M.cols() - rank, Rational(0));
  Eigen::Index column = 0, row = 0;
  for (Eigen::Index j = 0; j < M.cols(); ++j) {
    if (row < rank && echelon.pivots[static_cast<std::size_t>(row)] == j) {
      ++row;
      continue;
    }
    result(j, column) = 1;
    for (Eigen::Index r = 0; r < row; ++r)
      result(echelon.pivots[static_cast<std::size_t>(r)], column) = -echelon.rows(r, j);
    ++column;
  }
  return result;
}

/// From the echelon form of [M, B]: a pivot behind M says 0 = 1. Rows of X without a pivot are 0.
std::optional<RationalMatrix> rational_solution(const RationalMatrix& M, const RationalMatrix& B) {
  RationalMatrix whole(M.rows(), M.cols() + B.cols());
  whole << M, B;
  const Echelon echelon = reduced_echelon(std::move(whole));
  RationalMatrix X = RationalMatrix::Constant(M.cols(), B.cols(), Rational(0));
  for (std::size_t r = 0; r < echelon.pivots.size(); ++r) {
    const Eigen::Index pivot = echelon.pivots[r];
    if (pivot >= M.cols()) return std::nullopt;
    X.row(pivot) = echelon.rows.row(static_cast<Eigen::Index>(r)).tail(B.cols());
  }
  return X;
}

/// d_k = M_kk, v_k = M e_k/d_k, M <- M - d_k v_k v_k'; what is left of M is symmetric.
std::vector<std::pair<Rational, RationalMatrix>> rational_squares(RationalMatrix M) {
  std::vector<std::pair<Rational, RationalMatrix>> result;
  for (Eigen::Index k = 0; k < M.rows(); ++k) {
    const Rational pivot = M(k, k);
    if (pivot <= 0) return {};
    const RationalMatrix column = M.col(k) / pivot;
    result.emplace_back(pivot, column);
    M -= rational_product(column, column.transpose()) * pivot;
  }
  return result;
}

std::optional<RationalMatrix> rational_inverse(const RationalMatrix& M) {
  return rational_solution(M, RationalMatrix::Identity(M.rows(), M.rows()));
}

/// After k steps M = L [D, 0; 0, S] L' with D > 0, or >= 0; S is in the last rows and columns of M.
/// Where S_kk is not as it must be, L'v = e_k gives v'Mv = S_kk. Where S_kk = 0 and S_ik = m != 0,
/// a vector of rows k and i gives -1.
std::optional<RationalMatrix> rational_witness(RationalMatrix M, bool definite) {
  const Eigen::Index n = M.rows();
  RationalMatrix v = RationalMatrix::Constant(n, 1, Rational(0));
  // What is left of M is eliminated by rows 0 to k - 1: v there follows from the rest.
  const auto completed = [&](Eigen::Index k) {
    for (Eigen::Index i = k - 1; i >= 0; --i) {
      if (M(i, i) == 0) continue;
      Rational sum = 0;
      for (Eigen::Index j = i + 1; j < n; ++j)
        if (v(j) != 0) sum += M(i, j) * v(j);
      v(i) = -sum / M(i, i);
    }
    return v;
  };
  for (Eigen::Index k = 0; k < n; ++k) {
    if (M(k, k) < 0 || (M(k, k) == 0 && definite)) {
      v(k) = 1;
      return completed(k);
    }
    for (Eigen::Index i = k + 1; i < n; ++i) {
      if (M(i, k) == 0) continue;
      check_stop();
      if (M(k, k) == 0) {  // (t, 1) [0, m; m, d] (t, 1)' = 2 t m + d = -1
        v(i) = 1;
        v(k) = -(M(i, i) + 1) / (2 * M(i, k));
        return completed(k);
      }
      const Rational factor = M(i, k) / M(k, k);
      for (Eigen::Index j = k + 1; j < n; ++j) M(i, j) -= factor * M(k, j);
    }
  }
  return std::nullopt;
}

bool is_rational_definite(const RationalMatrix& M) { return !rational_witness(M, true); }

bool is_rational_semidefinite(const RationalMatrix& M) { return !rational_witness(M, false); }

}  // namespace gainsmith::numbers
