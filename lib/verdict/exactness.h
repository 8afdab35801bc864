// Whether multipliers that are only nearly a certificate are near an exact one.
//
// Y_k = L_k L_k' > 0 with residuals r_i = sum_k <B_ki, Y_k>. With g_i the elements of all L_k' B_ki
// L_k (and of v for i = 0), H_ij = g_i' g_j. When r' H^-1 r < 1 the correction
//   dY_k = -sum_j (H^-1 r)_j Y_k B_kj Y_k
// is smaller than Y_k, so that Y + dY is a certificate without any residual. L_k may have fewer
// columns than rows: whatever it is, it defines Y_k.
#pragma once

#include <optional>
#include <vector>

#include "verdict/exact.h"

namespace gainsmith::verdict {

/// A block with the factor L of its multiplier L L'.
template <class S>
struct FactoredBlock {
  const ExactBlock<S>* block = nullptr;
  numbers::Matrix L;  ///< n_k x rank
};

/// g_i, and a bound of its error in the norm of Frobenius.
struct Images {
  /// (1 + sum_k r_k (r_k + 1)/2) x (m + 1), r_k the columns of L_k; off-diagonal elements times
  /// sqrt(2), so that g_i'g_j is the sum over k of <L'B_ki L, L'B_kj L>.
  numbers::Matrix G;
  numbers::Vector error;
};
/// The columns g_0 ... g_m of `unknowns` = m + 1, a block after the other, below them a row of
/// zeros.
template <class S>
Images images_of(const std::vector<FactoredBlock<S>>& blocks, Eigen::Index unknowns);

/// r_i with |true - r_i| <= error_i; r_0 = -v.
struct ResidualsInDouble {
  numbers::Vector r;
  numbers::Vector error;
};

/// The g_i of the unknowns that occur, each of length 1, with R near H^-1/2.
struct Basis {
  std::vector<Eigen::Index> used;
  numbers::Vector lengths;  ///< of all g_i; 0: the unknown does not occur
  /// G with the columns of unknowns in `used`, each divided by its length; R upper triangular.
  numbers::Matrix G, R;
  Eigen::Index first = 1;  ///< the first unknown that counts
  double sigma = 1;        ///< at most the smallest singular value of G R
  /// A bound of what rounding changes of a product with G or R, relative to its terms.
  double roundings = 0;
};
/// Of g_first ... g_m; none where what is known of one does not tell whether it is 0, or they
/// depend on each other.
std::optional<Basis> basis_of(const Images& images, Eigen::Index first);

/// theta^2 >= r' H^-1 r: with R near H^-1/2, theta = |R' r| / sigma, sigma the smallest singular
/// value of G R less what rounding and the radii of the B_ki change of it.
struct Move {
  double theta = 0;       ///< rounded upward
  numbers::Vector steps;  ///< H^-1 r times the lengths of the g_i, about
};
/// None where an unknown that does not occur has a residual.
std::optional<Move> move_of(const Basis& by, const ResidualsInDouble& residuals);

/// theta < 1, shown in double. False says nothing. `constant`: unknown 0 counts, with v > 0.
template <class S>
bool is_exact_in_double(const std::vector<FactoredBlock<S>>& blocks,
                        const ResidualsInDouble& residuals, bool constant);

/// A block with its multiplier.
template <class S>
struct WeighedBlock {
  const ExactBlock<S>* block = nullptr;
  const numbers::MatrixOf<S>* Y = nullptr;
};

/// The same with H in S, for multipliers that are nearly singular: with any R near H^-1/2,
/// r' H^-1 r <= |R' r|^2 / (1 - |I - R' H R|). Of many unknowns it says nothing: what it leaves
/// open other certificates decide in less time.
template <class S>
bool is_exact_in_wide(const std::vector<WeighedBlock<S>>& blocks,
                      const Eigen::Matrix<S, Eigen::Dynamic, 1>& residuals,
                      const numbers::Vector& error, bool constant);

}  // namespace gainsmith::verdict
