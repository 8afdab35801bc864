// An approximate inverse of the Schur operator: diagonal in a basis that suits each unknown.
#pragma once

#include <vector>

#include "sdp/schur/matrix_operator.h"

namespace gainsmith::sdp {

/// For symmetric V the basis Q: Q0 = T^-T with T T' the sum of E'W E + F W F' over all terms, and
/// Q = Q0 U with the eigenvectors U of Q0' M(Q0 Q0') Q0, the image of the identity; for a full V
/// one basis for each side. There M counts as its diagonal, and unknowns as not coupled. Before
/// that, a full Y beside a symmetric P, as in He(E (P F + Y C)), is replaced by Y + P K with
///   K = sum w F W C' (sum w C W C')^-1,  w = tr(E'W E), sums over the terms of Y,
/// which takes most of their coupling: what is left of F is orthogonal to C. Not where P has two
/// terms in a block of Y: there it would add more coupling than it takes.
class Preconditioner {
 public:
  explicit Preconditioner(const MatrixOperator& of);

  /// G: factors of the scaling, W = G G'.
  void prepare(const SchurOperator& M, const Blocks<double>& G);
  /// z = about M^-1 r.
  void apply(const Vector<double>& r, Vector<double>& z) const;

 private:
  /// G'E and G'F' of one term.
  struct Sides {
    Matrix<double> E, F;
  };
  /// By blocks; many have none.
  using Terms = std::vector<std::vector<Sides>>;
  struct Basis {
    Matrix<double> left, right;  ///< V = left Z right'; right empty: left
    Matrix<double> weights;      ///< 1 / D
  };
  /// Y or Y' beside P: both are beside a common side somewhere.
  struct Link {
    std::size_t P, Y;
    bool transposed;  ///< Y' P has the common side
    Matrix<double> K;
  };

  void find_links();
  bool shares_a_side(std::size_t P, std::size_t Y, bool transposed) const;
  bool is_twice(std::size_t P, std::size_t Y) const;
  Terms scaled_terms(std::size_t unknown, const Blocks<double>& G) const;
  void decouple(Link& link, std::vector<Terms>& terms) const;
  Basis symmetric_basis(const Terms& terms, Eigen::Index n) const;
  Basis full_basis(Terms terms, Eigen::Index rows, Eigen::Index columns) const;

  const MatrixOperator& of_;
  std::vector<Link> links_;
  std::vector<Basis> bases_;
  std::vector<double> scalars_;  ///< 1 / <G, W G W>
};

}  // namespace gainsmith::sdp
