// A semidefinite program whose variables are matrices: what a solver can use that never forms the
// Schur complement of the scalars.
#pragma once

#include <utility>
#include <vector>

namespace gainsmith::sdp {

/// Column by column.
struct DenseMatrix {
  int rows = 0;
  int columns = 0;
  std::vector<double> values;
};

/// minimise c'x  subject to
///   S_k(x) = C_k + sum_t He(E_t V_t F_t) + sum_i x_i G_ki >= 0,   He(M) = M + M',
///   a_r'x + a_r0 >= 0.
/// The matrices V and the other scalars are parts of the vector x, each scalar of one of them.
struct MatrixProgram {
  /// V: its scalars are x[first], x[first + 1], ... : column by column, of a symmetric matrix (rows
  /// = columns) column by column of its lower triangle, without factors sqrt(2).
  struct Unknown {
    int first = 0;
    int rows = 0;
    int columns = 0;
    bool symmetric = false;
  };
  /// He(E V F), E size x V.rows, F V.columns x size.
  struct Product {
    int unknown = 0;  ///< index of V
    DenseMatrix E;
    DenseMatrix F;
  };
  /// Of C (variable -1) or of G_i of a scalar outside the matrices; row <= column. Elements of one
  /// place add up.
  struct Element {
    int variable = -1;
    int row = 0;
    int column = 0;
    double value = 0;
  };
  struct Block {
    int size = 0;
    std::vector<Product> products;
    std::vector<Element> elements;
  };
  /// a_r0 and the elements of a_r that are not zero; any variable may be here.
  struct Row {
    double constant = 0;
    std::vector<std::pair<int, double>> coefficients;
  };

  std::vector<double> c;
  std::vector<Unknown> unknowns;
  std::vector<Block> blocks;
  std::vector<Row> rows;
};

}  // namespace gainsmith::sdp
