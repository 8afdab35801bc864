// Internal to numbers: determinants over numbers, balls, fractions and numbers with a slope alike.
#pragma once

#include <cstddef>
#include <utility>

#include "base/stop.h"
#include "numbers/dense/householder.h"

namespace gainsmith::numbers {

/// The matrix with the elements number(i, j), by columns.
template <class Number, class Element>
Columns<Number> columns_of(Eigen::Index rows, Eigen::Index cols, const Element& number) {
  Columns<Number> columns(static_cast<std::size_t>(cols));
  for (Eigen::Index j = 0; j < cols; ++j)
    for (Eigen::Index i = 0; i < rows; ++i)
      columns[static_cast<std::size_t>(j)].push_back(number(i, j));
  return columns;
}

/// The product of the pivots of Gauss' elimination, each the largest of what is left (complete
/// pivoting), times -1 for each exchange; 1 of an empty matrix. M is square, by columns. `size` of
/// a number is what is compared, 0 of what counts as 0: with two rows left and nothing in them the
/// determinant is 0, and so is its slope.
template <class Number, class Size>
Number determinant(Columns<Number> M, const Number& one, const Size& size) {
  Number product = one;
  for (std::size_t k = 0; k < M.size(); ++k) {
    check_stop();
    std::size_t row = k, column = k;
    for (std::size_t j = k; j < M.size(); ++j)
      for (std::size_t i = k; i < M.size(); ++i)
        if (size(M[column][row]) < size(M[j][i])) {
          row = i;
          column = j;
        }
    if ((row != k) != (column != k)) product = Number{} - product;
    std::swap(M[k], M[column]);
    for (std::vector<Number>& each : M) std::swap(each[k], each[row]);
    const Number pivot = M[k][k];
    product = product * pivot;
    if (k + 1 == M.size()) break;
    if (size(pivot) == size(Number{})) return Number{} * pivot;
    for (std::size_t j = k + 1; j < M.size(); ++j) {
      const Number factor = M[j][k] / pivot;
      for (std::size_t i = k + 1; i < M.size(); ++i) M[j][i] = M[j][i] - factor * M[k][i];
    }
  }
  return product;
}

}  // namespace gainsmith::numbers
