#include "sos/counterexample.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "base/stop.h"
#include "sos/identity.h"

namespace gainsmith::sos {

namespace {

/// v'M(x)v with v behind the variables x.
Polynomial quadratic_form(const Statement& statement, std::size_t n) {
  const polynomial::PolynomialMatrix& M = statement.matrix;
  if (M.rows() == 1) return M(0, 0);
  Polynomial sum;
  for (Eigen::Index c = 0; c < M.cols(); ++c)
    for (Eigen::Index r = 0; r < M.rows(); ++r) {
      const Monomial both =
          Monomial(n + static_cast<std::size_t>(r)) * Monomial(n + static_cast<std::size_t>(c));
      sum += M(r, c) * Polynomial(polynomial::Term{both, 0});
    }
  return sum;
}

/// Terms of polynomials that are not to be negative, and of p.
template <class Number>
using Terms = std::vector<std::vector<std::pair<Monomial, Number>>>;

/// p(x); none where another is negative.
template <class Number>
std::optional<Number> value_at(const Terms<Number>& polynomials, const std::vector<Number>& x) {
  Number value = 0;
  for (const auto& terms : polynomials) {
    if (!(value >= 0)) return std::nullopt;
    value = 0;
    for (const auto& [monomial, c] : terms) {
      Number product = c;
      for (std::size_t i = 0; i < monomial.variables(); ++i)
        for (int e = monomial.exponent(i); e > 0; --e) product *= x[i];
      value += product;
    }
  }
  return value;
}

/// Steps along the axes, longer after one that leads down and otherwise half as long, until p < 0.
void descend(const Terms<double>& p, std::vector<double>& x) {
  // Lengths of steps at which the descent ends.
  constexpr double kShort = 1e-9, kFar = 1e6;
  auto value = value_at(p, x);
  for (double length = 1; value && *value >= 0 && length > kShort && length < kFar;) {
    bool is_lower = false;
    for (double& at : x)
      for (const double step : {length, -length}) {
        at += step;
        const auto found = value_at(p, x);
        if (found && *found < *value) {
          value = found;
          is_lower = true;
        } else {
          at -= step;
        }
      }
    length *= is_lower ? 2 : 0.5;
  }
}

}  // namespace

std::optional<Counterexample> find_counterexample(const Statement& statement) {
  const std::size_t n = variables_of(statement);
  const bool has_unknowns = std::ranges::any_of(
      statement.matrix.reshaped(), [](const Polynomial& p) { return p.unknown() != 0; });
  if (has_unknowns || !statement.zero.empty() || n == 0) return std::nullopt;
  std::vector<Polynomial> polynomials = statement.nonnegative;
  polynomials.push_back(quadratic_form(statement, n));
  Terms<double> near;
  Terms<Rational> exact;
  for (const Polynomial& p : polynomials) {
    near.emplace_back();
    exact.emplace_back();
    for (const auto& [term, c] : p.terms()) {
      near.back().emplace_back(term.monomial, nearest_double(c));
      exact.back().emplace_back(term.monomial, c);
    }
  }
  const auto rows = static_cast<std::size_t>(statement.matrix.rows());
  constexpr std::uint64_t kStarts = 100;
  for (std::uint64_t start = 0; start < kStarts; ++start) {
    check_stop();
    RandomStream stream(1, start);
    // Starts in cubes about 0 whose sides are 0.2 to 20.
    const double size = std::pow(10, 2 * stream.uniform() - 1);
    std::vector<double> x(n + (rows > 1 ? rows : 0));
    for (double& at : x) at = size * (2 * stream.uniform() - 1);
    descend(near, x);
    // The shortest decimals at which p < 0 holds in fractions.
    for (const int decimals : {0, 1, 2, 4, 8}) {
      std::vector<Rational> point;
      for (const double at : x) point.push_back(rounded_to(Rational(at), decimals));
      const auto value = value_at(exact, point);
      if (!value || *value >= 0) continue;
      const auto v = point.begin() + static_cast<std::ptrdiff_t>(n);
      Counterexample found{{point.begin(), v}, {v, point.end()}, *value};
      if (found.v.empty()) found.v = {1};
      return found;
    }
  }
  return std::nullopt;
}

}  // namespace gainsmith::sos
