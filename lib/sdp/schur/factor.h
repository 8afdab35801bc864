// Cholesky factors of a point of the cone, its inverse and the distance to the cone's boundary.
#pragma once

#include <Eigen/Eigenvalues>
#include <vector>

#include "sdp/core/extreme.h"
#include "sdp/core/view.h"
#include "sdp/schur/linalg.h"

namespace gainsmith::sdp {

/// For V in the interior of the cone: V = L L', V^-1, and the longest step along a direction.
template <typename T>
class ConeFactor {
 public:
  explicit ConeFactor(const Layout& layout);

  /// Factors V; false when V is not positive definite (in this arithmetic).
  bool factorise(const Blocks<T>& V);

  /// V^-1 = L^-T L^-1; both triangles.
  void inverse(Blocks<T>& result);

  /// M := M V^-1 = (M L^-T) L^-1 for a matrix M like block b. Rounding counts with the condition
  /// of L twice; with a stored V^-1 it would with that of V.
  void divide(int b, const View<T>& M, const View<T>& work);

  /// The largest a <= `longest` with V + a D >= 0, or up to a hundredth less: a = -1 / l with a
  /// lower bound l of lambda_min(L^-1 D L^-T) where that is negative. In large blocks, in double, l
  /// may miss the smallest eigenvalue (extreme.h) and a be too long. The eigenvalues of that
  /// well-scaled matrix are taken in double in every arithmetic: a step length needs no more
  /// digits.
  T step(const Blocks<T>& D, const T& longest);

 private:
  /// Of L^-1 D L^-T in block b, or a close lower bound; anything above `enough` will do.
  double smallest_eigenvalue(const Blocks<T>& D, int b, double enough);

  /// L^-1 and L^-T of block b, where they are not there yet.
  void invert(int b);

  const Layout& layout_;
  Blocks<T> factor_;             ///< L, in the lower triangle
  Blocks<T> inverse_factor_;     ///< L^-1, upper triangle zero; 1/v in the linear part
  Blocks<T> inverse_transpose_;  ///< L^-T
  std::vector<bool> inverted_;   ///< are they of the present L?
  Blocks<T> work_, scaled_;
  /// L^-1 D L^-T of a block in double, and the workspace for its smallest eigenvalue.
  struct Spectrum {
    explicit Spectrum(int n)
        : w(n, n), shifted(n, n), reduction(n), diagonal(n), subdiagonal(n - 1) {}
    Eigen::MatrixXd w, shifted;
    Eigen::Tridiagonalization<Eigen::MatrixXd> reduction;
    Eigen::VectorXd diagonal, subdiagonal;
  };
  std::vector<Spectrum> spectra_;
  std::vector<Lanczos> lanczos_;
};

}  // namespace gainsmith::sdp
