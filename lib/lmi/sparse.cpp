#include "lmi/sparse.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace gainsmith::lmi {

// No threshold: only exact zeros are left out.
Sparse sparse(const Eigen::MatrixXd& matrix) { return matrix.sparseView(0.0, 0.0); }

bool is_symmetric(const Sparse& matrix) {
  if (matrix.rows() != matrix.cols()) return false;
  for (int k = 0; k < matrix.outerSize(); ++k)
    for (Sparse::InnerIterator it(matrix, k); it; ++it)
      if (matrix.coeff(it.col(), it.row()) != it.value()) return false;
  return true;
}

double largest_element(const Sparse& matrix) {
  double result = 0;
  for (int k = 0; k < matrix.outerSize(); ++k)
    for (Sparse::InnerIterator it(matrix, k); it; ++it)
      result = std::max(result, std::abs(it.value()));
  return result;
}

// Column j of A B is the sum of B_kj A(:, k), gathered in a dense column. What cancels stays as a
// stored 0.
Sparse multiplied(const Sparse& a, const Sparse& b) {
  Sparse result(a.rows(), b.cols());
  Eigen::Index most = 0;
  for (int j = 0; j < b.outerSize(); ++j)
    for (Sparse::InnerIterator right(b, j); right; ++right)
      most += a.outerIndexPtr()[right.index() + 1] - a.outerIndexPtr()[right.index()];
  result.reserve(std::min(most, result.rows() * result.cols()));
  std::vector<double> column(static_cast<std::size_t>(a.rows()));
  std::vector<char> stands(static_cast<std::size_t>(a.rows()), 0);
  for (int j = 0; j < b.outerSize(); ++j) {
    result.startVec(j);
    int first = static_cast<int>(a.rows());
    int last = -1;
    for (Sparse::InnerIterator right(b, j); right; ++right) {
      for (Sparse::InnerIterator left(a, right.index()); left; ++left) {
        const auto row = static_cast<std::size_t>(left.index());
        const double term = left.value() * right.value();
        column[row] = stands[row] != 0 ? column[row] + term : term;
        stands[row] = 1;
        first = std::min(first, static_cast<int>(left.index()));
        last = std::max(last, static_cast<int>(left.index()));
      }
    }
    for (int i = first; i <= last; ++i) {
      const auto row = static_cast<std::size_t>(i);
      if (stands[row] != 0) result.insertBack(i, j) = column[row];
      stands[row] = 0;
    }
  }
  result.finalize();
  return result;
}

Sparse placed(const Sparse& matrix, int rows, int cols, int row, int column) {
  Sparse result(rows, cols);
  result.reserve(matrix.nonZeros());
  for (int j = 0; j < cols; ++j) {
    result.startVec(j);
    if (j < column || j >= column + matrix.cols()) continue;
    for (Sparse::InnerIterator it(matrix, j - column); it; ++it)
      result.insertBack(it.index() + row, j) = it.value();
  }
  result.finalize();
  return result;
}

void add_multiple(Eigen::MatrixXd& sum, double factor, const Sparse& matrix) {
  for (int j = 0; j < matrix.outerSize(); ++j)
    for (Sparse::InnerIterator it(matrix, j); it; ++it) sum(it.row(), j) += factor * it.value();
}

// Merges the columns, which are sorted by rows.
Sparse sum_of(const Sparse& a, const Sparse& b, double factor) {
  Sparse result(a.rows(), a.cols());
  result.reserve(a.nonZeros() + b.nonZeros());
  for (int j = 0; j < a.outerSize(); ++j) {
    result.startVec(j);
    Sparse::InnerIterator left(a, j);
    Sparse::InnerIterator right(b, j);
    while (left || right) {
      const bool takes_left = left && (!right || left.index() <= right.index());
      const bool takes_right = right && (!left || right.index() <= left.index());
      const int row = static_cast<int>(takes_left ? left.index() : right.index());
      double value = takes_left ? left.value() : factor * right.value();
      if (takes_left && takes_right) value += factor * right.value();
      if (takes_left) ++left;
      if (takes_right) ++right;
      if (value != 0) result.insertBack(row, j) = value;
    }
  }
  result.finalize();
  return result;
}

}  // namespace gainsmith::lmi
