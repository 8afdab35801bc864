#include "verdict/printable.h"

#include <algorithm>
#include <cmath>

#include "numerics/lattice.h"

namespace gainsmith::verdict {

namespace {

using numbers::RationalMatrix;

/// The double that is printed as this fraction.
std::optional<double> printed_as(const Rational& x) {
  const double value = nearest_double(x);
  if (!std::isfinite(value) || printed_fraction(value) != x) return std::nullopt;
  return value;
}

/// q with 10^q x_i a whole number of so many digits.
int decimals_of(const Rational& x, double unit, int digits) {
  constexpr double kFarBelow = 1e-6;
  const double size = std::max(std::abs(nearest_double(x)), kFarBelow * unit);
  if (!(size > 0) || !std::isfinite(size)) return digits;
  return digits - 1 - static_cast<int>(std::floor(std::log10(size)));
}

Rational rounded(const Rational& x, int decimals) {
  return Rational(nearest_integer(Rational(x * power_of_ten(decimals)))) * power_of_ten(-decimals);
}

/// The equations of the space between unknowns that move, one a row.
struct Equations {
  std::vector<Eigen::Index> unknowns;  ///< that occur in them, from 0
  RationalMatrix A;
  RationalMatrix b;
};

/// A x = b, a row for each equation with an unknown that moves; the others are numbers in b.
Equations equations_of(const Faces& faces) {
  const RationalMatrix& N = faces.directions();
  const auto moves = [&](int i) {
    return std::any_of(N.row(i - 1).begin(), N.row(i - 1).end(),
                       [](const Rational& x) { return x != 0; });
  };
  std::vector<Eigen::Index> place(static_cast<std::size_t>(N.rows()), -1);
  std::vector<const Faces::Equation*> rows;
  Equations result;
  for (const Faces::Equation& equation : faces.equations()) {
    bool any = false;
    for (const auto& [i, a] : equation.terms) {
      if (!moves(i)) continue;
      any = true;
      Eigen::Index& at = place[static_cast<std::size_t>(i) - 1];
      if (at >= 0) continue;
      at = std::ssize(result.unknowns);
      result.unknowns.push_back(i - 1);
    }
    if (any) rows.push_back(&equation);
  }
  result.A = RationalMatrix::Constant(std::ssize(rows), std::ssize(result.unknowns), Rational(0));
  result.b = RationalMatrix::Constant(std::ssize(rows), 1, Rational(0));
  for (Eigen::Index r = 0; r < std::ssize(rows); ++r) {
    const Faces::Equation& equation = *rows[static_cast<std::size_t>(r)];
    result.b(r) = equation.right;
    for (const auto& [i, a] : equation.terms) {
      const auto x = static_cast<std::size_t>(i) - 1;
      if (place[x] < 0)
        result.b(r) -= a * faces.origin()[x];
      else
        result.A(r, place[x]) = a;
    }
  }
  return result;
}

}  // namespace

std::optional<std::vector<double>> printable_point(const Faces& faces,
                                                   const std::vector<Rational>& y,
                                                   const std::vector<double>& units, int digits) {
  // Unknowns that stay are rounded; the others follow from the equations in whole numbers, near x.
  std::vector<Rational> x = faces.point(y);
  const Equations equations = equations_of(faces);
  std::vector<int> decimals;
  for (std::size_t i = 0; i < x.size(); ++i)
    decimals.push_back(decimals_of(x[i], units[i], digits));
  for (const int i : faces.free()) {
    Rational& value = x[static_cast<std::size_t>(i) - 1];
    value = rounded(value, decimals[static_cast<std::size_t>(i) - 1]);
  }
  if (!equations.unknowns.empty()) {
    RationalMatrix A = equations.A;
    std::vector<Rational> near;
    for (Eigen::Index c = 0; c < A.cols(); ++c) {
      const auto i = static_cast<std::size_t>(equations.unknowns[static_cast<std::size_t>(c)]);
      for (Eigen::Index r = 0; r < A.rows(); ++r) A(r, c) *= power_of_ten(-decimals[i]);
      near.push_back(Rational(x[i] * power_of_ten(decimals[i])));
    }
    const auto X = numerics::whole_solution(A, equations.b, near);
    if (!X) return std::nullopt;
    for (std::size_t c = 0; c < X->size(); ++c) {
      const auto i = static_cast<std::size_t>(equations.unknowns[c]);
      x[i] = Rational((*X)[c]) * power_of_ten(-decimals[i]);
    }
  }
  std::vector<double> result;
  for (const Rational& value : x) {
    const auto printed = printed_as(value);
    if (!printed) return std::nullopt;
    result.push_back(*printed);
  }
  return result;
}

}  // namespace gainsmith::verdict
