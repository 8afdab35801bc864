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

/// A polynomial of doubles, for a search.
class Values {
 public:
  explicit Values(const Polynomial& p) {
    for (const auto& [term, c] : p.terms()) terms_.emplace_back(term.monomial, nearest_double(c));
  }

  double operator()(const std::vector<double>& x) const {
    double sum = 0;
    for (const auto& [monomial, c] : terms_) {
      double product = c;
      for (std::size_t i = 0; i < monomial.variables(); ++i)
        for (int e = monomial.exponent(i); e > 0; --e) product *= x[i];
      sum += product;
    }
    return sum;
  }

 private:
  std::vector<std::pair<Monomial, double>> terms_;
};

Rational value_at(const Polynomial& p, const std::vector<Rational>& x) {
  std::vector<Polynomial> values(x.begin(), x.end());
  return substituted(p, 0, values).number();
}

class Search {
 public:
  Search(const Statement& statement, std::size_t n)
      : statement_(statement),
        n_(n),
        size_(n + (statement.matrix.rows() > 1 ? static_cast<std::size_t>(statement.matrix.rows())
                                               : 0)),
        p_(quadratic_form(statement, n)),
        value_(p_) {
    for (std::size_t i = 0; i < size_; ++i) slopes_.emplace_back(derivative(p_, i));
    for (const Polynomial& g : statement.nonnegative) within_.emplace_back(g);
  }

  std::optional<Counterexample> run() {
    constexpr std::uint64_t kStarts = 100;
    for (std::uint64_t start = 0; start < kStarts; ++start) {
      check_stop();
      std::vector<double> x = drawn(start);
      if (!is_within(x)) continue;
      descend(x);
      if (auto found = in_fractions(x)) return found;
    }
    return std::nullopt;
  }

 private:
  std::vector<double> drawn(std::uint64_t start) const {
    RandomStream stream(1, start);
    const double size = std::pow(10, 2 * stream.uniform() - 1);
    std::vector<double> x;
    for (std::size_t i = 0; i < size_; ++i) x.push_back(size * (2 * stream.uniform() - 1));
    return x;
  }

  bool is_within(const std::vector<double>& x) const {
    return std::ranges::all_of(within_, [&](const Values& g) { return g(x) >= 0; });
  }

  void descend(std::vector<double>& x) const {
    constexpr int kSteps = 200, kHalvings = 40;
    constexpr double kFar = 1e6;
    double value = value_(x), length = 1;
    for (int step = 0; step < kSteps && value >= 0; ++step) {
      std::vector<double> slope;
      double norm = 0;
      for (const Values& one : slopes_) {
        slope.push_back(one(x));
        norm += slope.back() * slope.back();
      }
      norm = std::sqrt(norm);
      if (!(norm > 0) || !std::isfinite(norm)) return;
      bool is_lower = false;
      for (int k = 0; k < kHalvings && !is_lower; ++k, length /= 2) {
        std::vector<double> next = x;
        for (std::size_t i = 0; i < size_; ++i) next[i] -= length / norm * slope[i];
        const double found = value_(next);
        is_lower = found < value && std::abs(next[0]) < kFar && is_within(next);
        if (!is_lower) continue;
        x = next;
        value = found;
      }
      if (!is_lower) return;
      length *= 4;
    }
  }

  std::optional<Counterexample> in_fractions(const std::vector<double>& x) const {
    for (const int decimals : {0, 1, 2, 4, 8}) {
      std::vector<Rational> point;
      for (const double value : x) point.push_back(rounded_to(Rational(value), decimals));
      const Rational value = value_at(p_, point);
      const bool is_inside = std::ranges::all_of(
          statement_.nonnegative, [&](const Polynomial& g) { return value_at(g, point) >= 0; });
      if (value >= 0 || !is_inside) continue;
      Counterexample found{{point.begin(), point.begin() + static_cast<std::ptrdiff_t>(n_)},
                           {point.begin() + static_cast<std::ptrdiff_t>(n_), point.end()},
                           value};
      if (found.v.empty()) found.v = {1};
      return found;
    }
    return std::nullopt;
  }

  const Statement& statement_;
  const std::size_t n_, size_;
  const Polynomial p_;
  const Values value_;
  std::vector<Values> slopes_, within_;
};

}  // namespace

std::optional<Counterexample> find_counterexample(const Statement& statement) {
  std::size_t n = 0;
  for (const Polynomial& p : statement.matrix.reshaped()) {
    if (p.unknown() != 0) return std::nullopt;
    n = std::max(n, p.variables());
  }
  for (const Polynomial& g : statement.nonnegative) n = std::max(n, g.variables());
  if (!statement.zero.empty() || n == 0) return std::nullopt;
  return Search(statement, n).run();
}

}  // namespace gainsmith::sos
