// The flow x' = A x of a length s and integrals of quadratic forms along it, in 100 digits.
//
//   E(s) = expm(s A),   W(s) = int_0^s E(t)' Q E(t) dt
//
// of a short length by their series and of longer ones by doubling,
//
//   E(2 s) = E(s)^2,   W(2 s) = W(s) + E(s)' W(s) E(s)
//
// in units in which A is small (numerics/balance.h).
//
// Series and doubling together are scaling and squaring. In 100 digits the rounding of the
// squarings is far below double precision. Van Loan 1978 finds W from one exponential of twice the
// size.
//
//   E = sum_k (s A)^k/k!,   W = sum_k X_k,   X_0 = s Q,   X_k = s (A' X_(k-1) + X_(k-1) A)/(k + 1)
#pragma once

#include <Eigen/Core>
#include <vector>

#include "base/eigen_scalars.h"
#include "base/scalars.h"
#include "numbers/matrix.h"

namespace gainsmith::linear {

using Wide = numbers::MatrixOf<Decimal100>;

/// A n x n, each form Q n x n and symmetric. E, W n x n.
class WideFlow {
 public:
  struct Values {
    Wide E;
    std::vector<Wide> W;  ///< by form
  };

  /// For 0 <= s <= longest; flow_norm(A, longest) is at most kLongestFlow.
  WideFlow(const Wide& A, const std::vector<Wide>& forms, double longest);

  Values operator()(const Decimal100& s) const;

 private:
  std::vector<int> units_;
  double unit_ = 1;                           ///< series are of s/unit
  int doublings_ = 0;                         ///< from the series to s
  std::vector<Wide> flow_;                    ///< of rising powers
  std::vector<std::vector<Wide>> integrals_;  ///< by form, from power 1 on
};

/// E'Q E.
Wide moved(const Wide& E, const Wide& Q);

/// The 1-norm of A times a length, in units in which it is small.
double flow_norm(const Wide& A, double length);

/// A matrix of rank r as B D, with D (r x n) r of its rows and B (n x r).
struct RankFactors {
  Wide B, D;
  std::vector<Eigen::Index> rows;  ///< which are D
};
/// Elimination with complete pivoting. A pivot below kCoefficientNoise of the largest element is 0,
/// and ends it.
RankFactors rank_factors(const Wide& matrix);

/// Whether x'Q x >= 0 for every x; Q symmetric.
bool is_semidefinite(Wide Q);

}  // namespace gainsmith::linear
