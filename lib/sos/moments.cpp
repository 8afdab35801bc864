#include "sos/moments.h"

#include <algorithm>
#include <cmath>

#include "base/stop.h"
#include "numbers/dense/rational_algebra.h"
#include "numbers/matrix.h"
#include "sos/identity.h"

namespace gainsmith::sos {

using numbers::RationalMatrix;

namespace {

/// sum_i y_i F_ij + D_j.
std::vector<RationalMatrix> matrices(const Program& program, const Eliminated& eliminated,
                                     const Semidefinite& posed, const Moments& y,
                                     const Equation* objective) {
  const Columns columns(program);
  std::vector<RationalMatrix> result;
  for (const Gram& gram : program.grams)
    result.push_back(RationalMatrix::Zero(gram.size(), gram.size()));
  const auto add = [&](const Equation& equation, const Rational& factor) {
    for (const auto& [column, c] : equation.terms) {
      const Columns::Place place = columns.place(column);
      const Rational value = c * factor / (place.row == place.column ? 1 : 2);
      result[place.gram](place.row, place.column) += value;
      if (place.row != place.column) result[place.gram](place.column, place.row) += value;
    }
  };
  for (std::size_t i = 0; i < y.size(); ++i)
    if (y[i] != 0) add(eliminated.equations[posed.equations[i]], y[i]);
  if (objective != nullptr) add(*objective, Rational(1));
  return result;
}

/// Whether it is shown for all, of singular ones only up to kSmall rows.
bool are_semidefinite(const std::vector<RationalMatrix>& X) {
  constexpr Eigen::Index kSmall = 30;
  return std::ranges::all_of(X, [](const RationalMatrix& matrix) {
    check_stop();
    return is_shown_definite(matrix) ||
           (matrix.rows() <= kSmall && numbers::is_rational_semidefinite(matrix));
  });
}

/// max |x_i|.
double size_of(const std::vector<double>& x) {
  return numbers::Vector::Map(x.data(), std::ssize(x)).lpNorm<Eigen::Infinity>();
}

/// With so many digits of the largest.
Moments rounded(const std::vector<double>& x, int digits) {
  const double largest = size_of(x);
  if (!std::isfinite(largest)) return Moments(x.size(), Rational(0));
  const int decimals = decimals_for(largest, digits);
  Moments result;
  for (const double value : x) result.push_back(rounded_to(Rational(value), decimals));
  return result;
}

/// c'y.
Rational value_of(const Eliminated& eliminated, const Semidefinite& posed, const Moments& y) {
  Rational sum = 0;
  for (std::size_t i = 0; i < y.size(); ++i)
    sum += y[i] * eliminated.equations[posed.equations[i]].value;
  return sum;
}

/// Whether X_j is not 0 at a constant of a strict inequality: M - c I is a sum of squares for a c >
/// 0, of which the moments are c tr X over the constants at least.
bool is_above_zero(const Program& program, const std::vector<RationalMatrix>& X) {
  for (std::size_t j = 0; j < X.size(); ++j) {
    const Gram& gram = program.grams[j];
    if (gram.multiplier != 0 || !program.statements[gram.statement].strict) continue;
    for (int a = 0; a < gram.size(); ++a)
      if (gram.basis[static_cast<std::size_t>(a)].front().first.monomial.degree() == 0 &&
          X[j](a, a) != 0)
        return true;
  }
  return false;
}

}  // namespace

std::map<Key, Rational> of_monomials(const std::vector<Equation>& equations,
                                     const Eliminated& eliminated, const Semidefinite& posed,
                                     const Moments& y) {
  std::map<Key, Rational> result;
  for (std::size_t i = 0; i < y.size(); ++i)
    for (const auto& [at, c] : eliminated.equations[posed.equations[i]].from)
      result[equations[at].key] += y[i] * c;
  std::erase_if(result, [](const auto& one) { return one.second == 0; });
  return result;
}

std::optional<Moments> excluding_moments(const Program& program, const Eliminated& eliminated,
                                         const Semidefinite& posed, const std::vector<double>& x) {
  // Few digits first: short fractions are quick to check and to print.
  for (const int digits : {3, 6, 12, 18}) {
    Moments y = rounded(x, digits);
    const Rational value = value_of(eliminated, posed, y);
    if (value > 0) continue;
    const auto X = matrices(program, eliminated, posed, y, nullptr);
    if ((value < 0 || is_above_zero(program, X)) && are_semidefinite(X)) return y;
  }
  return std::nullopt;
}

std::optional<Rational> lower_bound(const Program& program, const Eliminated& eliminated,
                                    const Semidefinite& posed, const Equation& objective,
                                    const std::vector<double>& x,
                                    const std::vector<double>& inside) {
  // Of the largest multiplier, that all of them keep.
  constexpr int kDigits = 18;
  // Shares of `inside` from none on: the first that is shown moves the bound least.
  const double unit = std::max(size_of(x), 1.0) / size_of(inside);
  for (const double share : {0.0, 1e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5}) {
    std::vector<double> both = x;
    for (std::size_t i = 0; i < both.size() && i < inside.size(); ++i)
      both[i] += share * unit * inside[i];
    const Moments y = rounded(both, kDigits);
    if (are_semidefinite(matrices(program, eliminated, posed, y, &objective)))
      return Rational(-value_of(eliminated, posed, y) - objective.value);
    if (inside.empty()) break;
  }
  return std::nullopt;
}

}  // namespace gainsmith::sos
