// An approximate inverse of the Schur operator: diagonal in a basis that suits each unknown.
#pragma once

#include <vector>

#include "sdp/matrix_operator.h"

namespace gainsmith::sdp {

/// For symmetric V the basis Q: Q0 = T^-T with T T' the sum of E'W E + F W F' over all terms, and
/// Q = Q0 U with the eigenvectors U of Q0' M(Q0 Q0') Q0, the image of the identity; for a full V
/// one basis for each side. There M counts as its diagonal; unknowns count as not coupled.
class Preconditioner {
 public:
  explicit Preconditioner(const MatrixOperator& of) : of_(of) {}

  /// G: factors of the scaling, W = G G'.
  void prepare(const SchurOperator& M, const Blocks<double>& G);
  /// z = about M^-1 r.
  void apply(const Vector<double>& r, Vector<double>& z) const;

 private:
  struct Basis {
    Matrix<double> left, right;  ///< V = left Z right'; right empty: left
    Matrix<double> weights;      ///< 1 / D
  };
  Basis symmetric_basis(std::size_t unknown, const SchurOperator& M,
                        const Blocks<double>& G) const;
  Basis full_basis(std::size_t unknown, const Blocks<double>& G) const;

  const MatrixOperator& of_;
  std::vector<Basis> bases_;
  std::vector<double> scalars_;  ///< 1 / <G, W G W>
};

}  // namespace gainsmith::sdp
