#include "lmi/gain_units.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gainsmith::lmi {

namespace {

constexpr int kNone = std::numeric_limits<int>::min();

/// log2 of the largest term of each element, in the units; kNone where there is none.
Eigen::MatrixXi exponents_of(const AffineForm& form, const std::vector<int>& units) {
  Eigen::MatrixXi result = Eigen::MatrixXi::Constant(form.shape.rows, form.shape.cols, kNone);
  for (const auto& [key, matrix] : expanded(form).terms) {
    const int unit = key.second == 0 ? 0 : units[static_cast<std::size_t>(key.second) - 1];
    for (int column = 0; column < matrix.outerSize(); ++column)
      for (Sparse::InnerIterator it(matrix, column); it; ++it)
        if (it.value() != 0)
          result(it.row(), column) =
              std::max(result(it.row(), column), std::ilogb(it.value()) + unit);
  }
  return result;
}

/// The element (r, c) of a form times 2^(rows_r + columns_c).
void scale(AffineForm& form, const Eigen::VectorXi& rows, const Eigen::VectorXi& columns) {
  for (auto& [key, matrix] : form.terms)
    for (int column = 0; column < matrix.outerSize(); ++column)
      for (Sparse::InnerIterator it(matrix, column); it; ++it)
        it.valueRef() = std::ldexp(it.value(), rows[it.row()] + columns[column]);
  for (Product& product : form.products) {
    for (int column = 0; column < product.left.outerSize(); ++column)
      for (Sparse::InnerIterator it(product.left, column); it; ++it)
        it.valueRef() = std::ldexp(it.value(), rows[it.row()]);
    for (int column = 0; column < product.right.outerSize(); ++column)
      for (Sparse::InnerIterator it(product.right, column); it; ++it)
        it.valueRef() = std::ldexp(it.value(), columns[column]);
  }
}

}  // namespace

void bring_to_units(AffineForm& S, AffineForm& E, bool is_unknown, const std::vector<int>& units) {
  const Eigen::MatrixXi of_S = exponents_of(S, units);
  const Eigen::MatrixXi of_E = exponents_of(E, units);
  Eigen::VectorXi T = Eigen::VectorXi::Zero(of_E.rows());
  for (Eigen::Index r = 0; r < T.size(); ++r) {
    const int own = is_unknown ? of_S(r, r) : of_E.row(r).maxCoeff();
    // Half of it, rounded down, for S has T twice.
    if (own != kNone) T[r] = is_unknown ? -(own >> 1) : -own;
  }
  Eigen::VectorXi V = T;
  // Of an S that is not symmetric T as its first column is, and V then as its diagonal is.
  if (is_unknown && !is_same(S, transposed(S)) && (of_S.col(0).array() != kNone).all() &&
      (of_S.diagonal().array() != kNone).all()) {
    T = -of_S.col(0);
    V = -of_S.diagonal() - T;
  }
  // The largest element of each column of T E is brought to 1.
  Eigen::VectorXi U = Eigen::VectorXi::Zero(of_E.cols());
  for (Eigen::Index c = 0; c < U.size(); ++c) {
    int largest = kNone;
    for (Eigen::Index r = 0; r < T.size(); ++r)
      if (of_E(r, c) != kNone) largest = std::max(largest, T[r] + of_E(r, c));
    if (largest != kNone) U[c] = -largest;
  }
  if (is_unknown) scale(S, T, V);
  scale(E, T, U);
}

}  // namespace gainsmith::lmi
