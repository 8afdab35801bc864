#include "verdict/implied_equations.h"

#include <Eigen/SparseCore>
#include <cmath>
#include <optional>

#include "base/eigen_scalars.h"
#include "base/rational.h"
#include "base/stop.h"
#include "numbers/dense/dense.h"

namespace gainsmith::verdict {

namespace {

using Eigen::Index;
using numbers::Matrix;
using numbers::Vector;

/// The B_i of all blocks as columns, x_1 first.
template <class S>
lmi::Sparse columns_of(const std::vector<ExactBlock<S>>& blocks, int unknowns) {
  std::vector<Eigen::Triplet<double>> elements;
  int first = 0;
  for (const ExactBlock<S>& block : blocks) {
    for (const auto& [i, list] : block.terms)
      if (i > 0)
        for (const auto& e : list)
          elements.emplace_back(first + e.row * block.size + e.column, i - 1, as<double>(e.mid));
    first += block.size * block.size;
  }
  lmi::Sparse result(first, unknowns);
  result.setFromTriplets(elements.begin(), elements.end());
  return result;
}

/// The kernel of the Gram matrix M'M, m x m with a diagonal of 1: its basis as rows in reduced
/// echelon form, 1 at their largest element. None where it is 0. Eigenvalues below 1e-12 count as
/// 0: singular values of M below 1e-6.
Matrix kernel_of(const Matrix& gram) {
  constexpr double kZero = 1e-12;
  const Matrix I = Matrix::Identity(gram.rows(), gram.cols());
  if (numbers::Cholesky(gram - kZero * I)) return {};
  const numbers::SymmetricEigen eigen(gram);
  const Index count = (eigen.values().array() < kZero).count();
  Matrix rows = eigen.vectors().leftCols(count).transpose();
  for (Index r = 0; r < count; ++r) {
    Index column = 0;
    rows.row(r).cwiseAbs().maxCoeff(&column);
    rows.row(r) /= rows(r, column);
    for (Index i = 0; i < count; ++i)
      if (i != r) rows.row(i) -= rows(i, column) * rows.row(r);
  }
  return rows;
}

/// d in short fractions, times what makes them whole; none where double does not hold that.
std::optional<std::vector<double>> whole_numbers_near(const Vector& d) {
  // Of a fraction: its relative error, and its largest numerator or denominator.
  constexpr double kRelative = 1e-9, kLongest = 1e6;
  std::vector<Rational> fractions;
  Integer whole = 1;
  for (const double x : d) {
    const auto fraction = short_fraction(Rational(x), kRelative, kLongest);
    if (!fraction) return std::nullopt;
    whole = lcm(whole, denominator(*fraction));
    fractions.push_back(*fraction);
  }
  std::vector<double> result;
  for (const Rational& x : fractions) {
    result.push_back(nearest_double(x * whole));
    if (Rational(result.back()) != x * whole) return std::nullopt;
  }
  return result;
}

}  // namespace

template <class S>
void drop_implied(const lmi::Inequalities& of, const lmi::Lmi& lmi,
                  const lmi::Formulation& formulation, std::vector<ExactBlock<S>>& blocks) {
  constexpr double kRounding = 1e-9;
  const auto m = static_cast<double>(lmi.unknowns);
  spend(m * m * m * kDoubleWork);
  const lmi::Sparse columns = columns_of(blocks, lmi.unknowns);
  Matrix gram = Matrix(columns.transpose() * columns);
  // What does not occur has no equation.
  const Vector lengths =
      gram.diagonal().cwiseSqrt().unaryExpr([](double x) { return x > 0 ? x : 1; });
  gram = lengths.cwiseInverse().asDiagonal() * gram * lengths.cwiseInverse().asDiagonal();
  gram.diagonal().setConstant(1);
  const Matrix kernel = kernel_of(gram);
  const ExactBlocks<S> exact(of, formulation.balance);
  for (Index r = 0; r < kernel.rows(); ++r) {
    Vector d = kernel.row(r);
    Index j = 0;
    d.cwiseAbs().maxCoeff(&j);
    for (Index i = 0; i < d.size(); ++i)
      d[i] = std::abs(d[i]) < kRounding
                 ? 0
                 : d[i] / lengths[i] * formulation.balance.unit(static_cast<int>(i) + 1);
    const auto direction = whole_numbers_near(d / d[j]);
    if (!direction) continue;
    bool vanishes = true;
    for (std::size_t k = 0; k < blocks.size() && vanishes; ++k)
      vanishes = exact.vanishes(lmi.blocks[k], formulation.free_variables.kept[k], *direction);
    if (!vanishes) continue;
    for (ExactBlock<S>& block : blocks)
      std::erase_if(block.terms, [&](const auto& term) { return term.first == j + 1; });
  }
}

template void drop_implied(const lmi::Inequalities&, const lmi::Lmi&, const lmi::Formulation&,
                           std::vector<ExactBlock<DoubleDouble>>&);
template void drop_implied(const lmi::Inequalities&, const lmi::Lmi&, const lmi::Formulation&,
                           std::vector<ExactBlock<Decimal100>>&);

}  // namespace gainsmith::verdict
