// Products with a matrix unknown between constant matrices: what a matrix inequality contains as
// long as nobody needs the coefficients of the unknown's scalars, of which there are thousands.
// The coefficient of V_ij in E V F is E(:, i) F(j, :); for a symmetric V and i != j the mirrored
// outer product is added.
#pragma once

#include <utility>
#include <vector>

#include "lmi/sparse.h"

namespace gainsmith::lmi {

/// The scalars of a matrix V, see unknowns.h: of a symmetric one column by column of the lower
/// triangle, of a full one column by column.
struct MatrixUnknown {
  int first = 1;  ///< index of its first scalar, from 1
  int rows = 0;
  int columns = 0;
  bool symmetric = false;

  int count() const { return symmetric ? rows * (rows + 1) / 2 : rows * columns; }

  bool operator==(const MatrixUnknown&) const = default;
};

/// phi_a E V F, or phi_a E V' F with phi_a a monomial.
struct Product {
  int monomial = 0;
  MatrixUnknown unknown;
  bool transposed = false;  ///< never of a symmetric V
  Sparse left;              ///< E
  Sparse right;             ///< F

  bool has_same_unknown(const Product& other) const {
    return monomial == other.monomial && unknown == other.unknown && transposed == other.transposed;
  }
};

/// Adds factor times a product to a sum of products. Those with a side that is the same, or the
/// same up to a factor, become one; what cancels is left out.
void add_product(std::vector<Product>& sum, Product product, double factor = 1);

/// (E V F)' = F' V' E'.
Product transposed(const Product& product);

/// He(E V F) = E V F + (E V F)' for every V.
struct HermitianProduct {
  MatrixUnknown unknown;
  Sparse left;   ///< E
  Sparse right;  ///< F
};

/// The symmetric part of a sum of products without monomials,  (S + S')/2 = sum_t He(E_t V_t F_t),
/// with as few terms as come of merging those with the same side.
std::vector<HermitianProduct> symmetric_part(const std::vector<Product>& sum);

/// No element of a coefficient of S - S' is larger: 0, or rounding, where the products say that S
/// is symmetric. A sum that is symmetric for another reason has a larger bound.
double asymmetry(const std::vector<Product>& sum);

/// The coefficients of the scalars: (i, M_i) in the order of i, without zeros. All products must
/// have the same monomial; rows and columns are those of the sum.
std::vector<std::pair<int, Sparse>> coefficients(const std::vector<Product>& sum, int rows,
                                                 int columns);
/// The same of a sum of He(E V F), exactly symmetric.
std::vector<std::pair<int, Sparse>> coefficients(const std::vector<HermitianProduct>& sum,
                                                 int size);

/// V at x.
Eigen::MatrixXd matrix_at(const MatrixUnknown& unknown, const std::vector<double>& x);

}  // namespace gainsmith::lmi
