// Small sparse matrices: coefficients of unknowns have few elements.
//
// Eigen's own products and setFromTriplets allocate and sort for large matrices; on coefficients
// with two elements that is most of the time of compiling a problem. Elements are added in the same
// order as by Eigen, so results have the same bits.
#pragma once

#include <Eigen/SparseCore>

namespace gainsmith::lmi {

using Sparse = Eigen::SparseMatrix<double>;

/// The elements of a dense matrix that are not 0.
Sparse sparse(const Eigen::MatrixXd& matrix);

bool is_symmetric(const Sparse& matrix);

/// The largest |element|.
double largest_element(const Sparse& matrix);

/// a b.
Sparse multiplied(const Sparse& a, const Sparse& b);

/// A rows x cols matrix with `matrix` at (row, column), zeros elsewhere.
Sparse placed(const Sparse& matrix, int rows, int cols, int row, int column);

/// sum += factor matrix.
void add_multiple(Eigen::MatrixXd& sum, double factor, const Sparse& matrix);

/// a + factor b, without elements that cancel.
Sparse sum_of(const Sparse& a, const Sparse& b, double factor);

}  // namespace gainsmith::lmi
