// The flow x' = A x of a length s and integrals of quadratic forms along it, in 100 digits.
//
//   E(s) = expm(s A) = sum_k (s^k/k!) A^k
//   W(s) = int_0^s E(t)' Q E(t) dt = sum_k (s^(k+1)/(k+1)!) F_k,  F_0 = Q, F_(k+1) = A'F_k + F_k A
#pragma once

#include <vector>

#include "base/eigen_scalars.h"
#include "base/scalars.h"
#include "numbers/matrix.h"

namespace gainsmith::packs {

using Wide = numbers::MatrixOf<Decimal100>;

/// A matrix as a power series of the length, of entries that are entire.
class MatrixSeries {
 public:
  /// expm(s A) for 0 <= s <= longest; the norm of A times longest is at most kLongestFlow.
  static MatrixSeries flow(const Wide& A, double longest);
  /// W(s) for the same lengths.
  static MatrixSeries integral(const Wide& A, const Wide& Q, double longest);

  Wide operator()(const Decimal100& s) const;

 private:
  double unit_ = 1;          ///< the powers are those of s/unit
  std::vector<Wide> terms_;  ///< of rising powers
};

/// The 1-norm of A times a length.
double flow_norm(const Wide& A, double length);

/// A matrix of rank r as B D, with D (r x n) r of its rows and B (n x r).
struct RankFactors {
  Wide B, D;
};
RankFactors rank_factors(const Wide& matrix);

/// Whether x'Q x >= 0 for every x; Q symmetric.
bool is_semidefinite(Wide Q);

}  // namespace gainsmith::packs
