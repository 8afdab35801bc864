#include "sos/identity.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/stop.h"
#include "numbers/dense/definite.h"
#include "numbers/dense/rational_algebra.h"

namespace gainsmith::sos {

using Eigen::Index;
using numbers::RationalMatrix;

Rational rounded_to(const Rational& x, int decimals) {
  const Rational unit = power_of_ten(decimals);
  return Rational(nearest_integer(Rational(x * unit))) / unit;
}

int decimals_for(double largest, int digits) {
  const bool has_size = largest > 0 && std::isfinite(largest);
  return digits - (has_size ? static_cast<int>(std::ceil(std::log10(largest))) : 0);
}

bool is_shown_definite(const RationalMatrix& Q) {
  numbers::Enclosed<DoubleDouble> enclosed;
  enclosed.resize(Q.rows(), Q.cols());
  for (Index i = 0; i < Q.size(); ++i) enclosed.set(i, numbers::ball_of(Q(i)));
  const numbers::Sign sign = numbers::definite(enclosed).sign;
  // Rows up to which elimination in fractions settles what enclosures leave open.
  constexpr Index kSmall = 30;
  if (sign == numbers::Sign::open && Q.rows() <= kSmall) return numbers::is_rational_definite(Q);
  return sign == numbers::Sign::positive;
}

namespace {

/// Whether a strict inequality stays above a constant: with Q > 0 it does where all constants are
/// combinations of the basis.
bool keeps_constants(const Program& program, const Gram& gram) {
  const Statement& statement = program.statements[gram.statement];
  if (gram.multiplier != 0 || !statement.strict) return true;
  std::map<Element, Index> places;
  for (int r = 0; r < statement.matrix.rows(); ++r) places[{r, {}}] = r;
  for (const BasisPolynomial& polynomial : gram.basis)
    for (const auto& [element, c] : polynomial) places.try_emplace(element, std::ssize(places));
  RationalMatrix basis = RationalMatrix::Zero(std::ssize(places), gram.size());
  for (Index k = 0; k < gram.size(); ++k)
    for (const auto& [element, c] : gram.basis[static_cast<std::size_t>(k)])
      basis(places.at(element), k) = c;
  const RationalMatrix constants = RationalMatrix::Identity(basis.rows(), statement.matrix.rows());
  return numbers::rational_solution(basis, constants).has_value();
}

/// The columns of a program in fractions: rounded, then moved until all equations hold.
class Rounding {
  static constexpr int kDigits = 13;  ///< that values are rounded to

 public:
  Rounding(const Program& program, const Point& point, const std::vector<Rational>& u)
      : program_(program),
        columns_(program),
        equations_(equations_of(program)),
        values_(static_cast<std::size_t>(columns_.size())),
        uses_(values_.size()),
        decimals_(values_.size()) {
    for (int k = 0; k < columns_.unknowns(); ++k) value(k) = u[static_cast<std::size_t>(k)];
    for (int k = columns_.unknowns(); k < columns_.frees(); ++k) {
      const double x = point.free[static_cast<std::size_t>(k)];
      set(k, x, decimals_for(std::max(std::abs(x), 1.0), kDigits));
    }
    for (std::size_t g = 0; g < program.grams.size(); ++g) {
      const numbers::Matrix& Q = point.grams[g];
      const int decimals = decimals_for(Q.lpNorm<Eigen::Infinity>(), kDigits);
      for (int c = 0; c < Q.cols(); ++c)
        for (int r = 0; r <= c; ++r) set(columns_.element(g, r, c), Q(r, c), decimals);
    }
    for (const Equation& equation : equations_)
      for (const auto& [column, c] : equation.terms) ++uses_[static_cast<std::size_t>(column)];
  }

  std::optional<Identity> take() {
    std::vector<std::size_t> bound;  // equations that share all their columns with others
    for (std::size_t i = 0; i < equations_.size(); ++i)
      if (!has_own(equations_[i])) bound.push_back(i);
    if (!solve(bound)) return std::nullopt;
    for (const Equation& equation : equations_) place(equation);
    for (const Equation& equation : equations_)
      if (residual(equation) != 0) return std::nullopt;
    Identity result;
    for (int k = 0; k < columns_.frees(); ++k) result.free.push_back(value(k));
    for (std::size_t g = 0; g < program_.grams.size(); ++g) {
      check_stop();
      const int n = program_.grams[g].size();
      RationalMatrix Q(n, n);
      for (int c = 0; c < n; ++c)
        for (int r = 0; r <= c; ++r) Q(r, c) = Q(c, r) = value(columns_.element(g, r, c));
      if (!is_shown_definite(Q) || !keeps_constants(program_, program_.grams[g]))
        return std::nullopt;
      result.grams.push_back(std::move(Q));
    }
    return result;
  }

 private:
  Rational& value(int column) { return values_[static_cast<std::size_t>(column)]; }
  void set(int column, double x, int decimals) {
    value(column) = std::isfinite(x) ? rounded_to(Rational(x), decimals) : Rational(0);
    decimals_[static_cast<std::size_t>(column)] = decimals;
  }

  /// An element of a Gram matrix that no other equation has.
  bool is_own(int column) const {
    return columns_.is_element(column) && uses_[static_cast<std::size_t>(column)] == 1;
  }
  bool has_own(const Equation& equation) const {
    return std::ranges::any_of(equation.terms,
                               [&](const auto& term) { return is_own(term.first); });
  }

  Rational residual(const Equation& equation) {
    Rational rest = equation.value;
    for (const auto& [column, c] : equation.terms) rest -= c * value(column);
    return rest;
  }

  /// Evenly to its own elements, in decimals but for what is left at the end.
  void place(const Equation& equation) {
    Rational rest = residual(equation);
    if (rest == 0) return;
    std::vector<std::pair<int, Rational>> own;
    Rational sum = 0;
    for (const auto& [column, c] : equation.terms)
      if (is_own(column)) {
        own.emplace_back(column, c);
        sum += abs(c);
      }
    if (own.empty()) return;
    // Decimals beyond those of the element itself.
    constexpr int kMore = 3;
    const Rational share = rest / sum;
    for (const auto& [column, c] : own) {
      const bool is_last = column == own.back().first;
      const int decimals = decimals_[static_cast<std::size_t>(column)] + kMore;
      const Rational change =
          is_last ? Rational(rest / c) : rounded_to(c > 0 ? share : Rational(-share), decimals);
      value(column) += change;
      rest -= c * change;
    }
  }

  /// z += W A' lambda with A W A' lambda = what is left, A over t and the elements of Gram matrices
  /// that these equations have: the least change, off-diagonal elements counting twice. Whether
  /// they have a solution.
  bool solve(const std::vector<std::size_t>& bound) {
    if (bound.empty()) return true;
    const auto weight = [&](int column) -> Rational {
      if (!columns_.is_element(column)) return 1;
      const Columns::Place place = columns_.place(column);
      return place.row == place.column ? Rational(1) : Rational(1, 2);
    };
    std::map<int, std::vector<std::pair<Index, Rational>>> by_column;
    const auto m = static_cast<Index>(bound.size());
    RationalMatrix rest(m, 1);
    for (Index i = 0; i < m; ++i) {
      const Equation& equation = equations_[bound[static_cast<std::size_t>(i)]];
      rest(i) = residual(equation);
      for (const auto& [column, c] : equation.terms)
        if (column >= columns_.unknowns()) by_column[column].emplace_back(i, c);
    }
    RationalMatrix G = RationalMatrix::Zero(m, m);
    for (const auto& [column, terms] : by_column)
      for (const auto& [i, c] : terms)
        for (const auto& [j, d] : terms) G(i, j) += weight(column) * c * d;
    const auto lambda = numbers::rational_solution(G, rest);
    if (!lambda) return false;
    for (const auto& [column, terms] : by_column)
      for (const auto& [i, c] : terms) value(column) += weight(column) * c * (*lambda)(i);
    return true;
  }

  const Program& program_;
  const Columns columns_;
  const std::vector<Equation> equations_;
  std::vector<Rational> values_;
  std::vector<int> uses_;      ///< in how many equations a column is
  std::vector<int> decimals_;  ///< that a column was rounded to
};

}  // namespace

std::optional<Identity> identity_near(const Program& program, const Point& point,
                                      const std::vector<Rational>& u) {
  return Rounding(program, point, u).take();
}

}  // namespace gainsmith::sos
