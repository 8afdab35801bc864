// Internal to numbers: what Real needs of a scalar beyond double.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "base/eigen_scalars.h"
#include "base/scalars.h"
#include "numbers/dense/wide_dense.h"
#include "numbers/types/ball.h"
#include "numbers/types/real_rules.h"
#include "numerics/balance.h"

namespace gainsmith::numbers {

/// e^M = (e^X)^(2^k), M n x n, with X = M / 2^k, |X| <= 1/2 in the 1-norm, and e^X by its series in
/// Horner's form, I + X (I + X/2 (I + X/3 (...))), of which the first term left out is below
/// epsilon / 8. At most 5000 squarings.
template <class Scalar>
MatrixOf<Scalar> balanced_exponential(const MatrixOf<Scalar>& M) {
  constexpr int kMostSquarings = 5000;
  if (M.size() == 0) return M;
  Scalar norm = M.cwiseAbs().colwise().sum().maxCoeff();
  Scalar scale(1);
  int squarings = 0;
  for (; norm > Scalar(0.5) && squarings < kMostSquarings; ++squarings) {
    norm = norm / Scalar(2);
    scale = scale / Scalar(2);
  }
  int terms = 1;
  for (Scalar term = norm; term > std::numeric_limits<Scalar>::epsilon() / Scalar(8); ++terms)
    term = term * norm / Scalar(terms + 1);
  const MatrixOf<Scalar> X = M * scale;
  const MatrixOf<Scalar> I = MatrixOf<Scalar>::Identity(M.rows(), M.cols());
  MatrixOf<Scalar> result = I;
  for (int k = terms; k >= 1; --k) result = I + times<Scalar>(X, result) / Scalar(k);
  for (int k = 0; k < squarings; ++k) result = times<Scalar>(result, result);
  return result;
}

/// e^M, in the units that numbers::exponential (dense.h) takes.
template <class Scalar>
MatrixOf<Scalar> wide_exponential(const MatrixOf<Scalar>& M) {
  const auto scale = [](const Scalar& x, int exponent) { return times_power_of_two(x, exponent); };
  std::vector<int> units = numerics::balance(
      M.unaryExpr([](const Scalar& x) { return std::abs(static_cast<double>(x)); }));
  const MatrixOf<Scalar> result = balanced_exponential<Scalar>(numerics::in_units(M, units, scale));
  for (int& unit : units) unit = -unit;
  return numerics::in_units(result, units, scale);
}

template <class Scalar>
struct WideFoundation {
  using Wide = MatrixOf<Scalar>;
  using Column = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

  static std::optional<Scalar> parse(const std::string& decimal) {
    return parse_as<Scalar>(decimal);
  }
  static std::optional<Scalar> pi() { return gainsmith::pi<Scalar>(); }
  /// As many epsilons as 1e-15 is for double.
  static Scalar least_condition() {
    return std::numeric_limits<Scalar>::epsilon() * Scalar(1e-15) /
           Scalar(std::numeric_limits<double>::epsilon());
  }
  static WideInverse<Scalar> inverse(const Wide& M) { return wide_inverse<Scalar>(M); }
  /// Largest first.
  static Column singular_values(const Wide& M) {
    if (M.size() == 0) return Column::Zero(0);
    Column values = wide_svd<Scalar>(M).s;
    std::sort(values.begin(), values.end(), std::greater<>());
    return values;
  }
  static WideSvd<Scalar> full_svd(const Wide& M) { return wide_svd<Scalar>(M); }
  static Wide exponential(const Wide& M) { return wide_exponential<Scalar>(M); }
};

template <>
struct Foundation<DoubleDouble> : WideFoundation<DoubleDouble> {};
template <>
struct Foundation<Decimal100> : WideFoundation<Decimal100> {};

}  // namespace gainsmith::numbers
