// The Schur operator of a program in matrices as a matrix, with its Cholesky factor.
#pragma once

#include <vector>

#include "sdp/schur/matrix_operator.h"

namespace gainsmith::sdp {

/// M_ij = <F_i, W F_j W>, L(x) = sum x_i F_i, formed without the F_i: between e_a e_b' in V of
/// He(E V F) and e_c e_d' in U of He(G U H) it is
///   2 (E'W G)_ac (F W H')_bd + 2 (E'W H')_ad (F W G)_bc
/// of each block that both are in. An unknown that shares blocks with few others comes first:
/// where it has no row in the factor, the factor takes no products (kernels.h).
class MatrixSchur {
 public:
  explicit MatrixSchur(const MatrixOperator& of);

  /// Multiplications to form and to factor M, about.
  double cost() const { return forming_ + factoring_; }
  /// Forms and factors M at the scaling W of `M`, perturbed as in Schur::factorise. False when no
  /// perturbation in reason succeeds. Throws what require_memory throws.
  bool prepare(const SchurOperator& M, const Blocks<double>& W);
  /// z = M^-1 r as the factor gives it.
  void apply(const Vector<double>& r, Vector<double>& z) const;

 private:
  /// The products of two terms of one block, of V and of U: E'W G, F W H', E'W H', F W G.
  struct Products {
    Matrix<double> EG, FH, EH, FG;
  };
  /// V, U and their common terms.
  struct Pair {
    std::size_t V, U;
    std::vector<Products> products;
  };

  void find_order();
  void estimate(std::vector<std::vector<bool>> coupled);
  /// The number of its scalars.
  std::size_t count(std::size_t unknown) const;
  /// Are both in some block?
  bool is_coupled(std::size_t V, std::size_t U) const;
  std::vector<Pair> pairs(std::size_t U, const Blocks<double>& W) const;
  void form(const SchurOperator& M, const Blocks<double>& W);
  void form_columns(std::size_t U, const std::vector<Pair>& pairs);
  void add_image(const Pair& pair, Eigen::Index c, Eigen::Index d, Vector<double>& column);
  void add_scalars(const SchurOperator& M);
  void add_rows(const Blocks<double>& W);

  const MatrixOperator& of_;
  std::vector<std::size_t> order_;      ///< of the unknowns
  std::vector<Eigen::Index> place_;     ///< of a variable in M
  double forming_ = 0, factoring_ = 0;  ///< multiplications
  Matrix<double> factor_;               ///< lower triangle
  Vector<double> scale_;                ///< diag(M)^-1/2
  Matrix<double> left_, right_, image_;
};

}  // namespace gainsmith::sdp
