#include "polynomial/polynomial.h"

#include <algorithm>

#include "base/stop.h"

namespace gainsmith::polynomial {

bool Polynomial::is_number() const {
  return terms_.empty() || (terms_.size() == 1 && terms_.begin()->first == Term{});
}

int Polynomial::unknown() const {
  for (const auto& [term, c] : terms_)
    if (term.unknown != 0) return term.unknown;
  return 0;
}

int Polynomial::degree() const {
  // Terms are in the order of their monomials, by degree first.
  return terms_.empty() ? 0 : terms_.rbegin()->first.monomial.degree();
}

std::size_t Polynomial::variables() const {
  std::size_t n = 0;
  for (const auto& [term, c] : terms_) n = std::max(n, term.monomial.variables());
  return n;
}

void Polynomial::add(const Term& term, const Rational& coefficient) {
  if (coefficient == 0) return;
  const auto [at, is_new] = terms_.try_emplace(term, coefficient);
  if (is_new) return;
  at->second += coefficient;
  if (at->second == 0) terms_.erase(at);
}

Polynomial& Polynomial::add(const Polynomial& other, const Rational& factor) {
  for (const auto& [term, c] : other.terms_) add(term, Rational(c * factor));
  return *this;
}

Polynomial& Polynomial::operator*=(const Rational& factor) {
  if (factor == 0) terms_.clear();
  for (auto& [term, c] : terms_) c *= factor;
  return *this;
}

Polynomial operator*(const Polynomial& a, const Polynomial& b) {
  // The number of terms may be the product of both.
  check_stop();
  Polynomial result;
  for (const auto& [s, c] : a.terms_)
    for (const auto& [t, d] : b.terms_) {
      if (s.unknown != 0 && t.unknown != 0) throw ProductOfUnknowns(s.unknown, t.unknown);
      result.add({s.monomial * t.monomial, s.unknown + t.unknown}, Rational(c * d));
    }
  return result;
}

Polynomial derivative(const Polynomial& p, std::size_t variable) {
  Polynomial result;
  for (const auto& [term, c] : p.terms()) {
    const int e = term.monomial.exponent(variable);
    if (e == 0) continue;
    // d(x_i^e m)/dx_i = e x_i^(e-1) m
    const Monomial lower = term.monomial.without(variable) * Monomial(variable, e - 1);
    result.add({lower, term.unknown}, Rational(c * e));
  }
  return result;
}

Polynomial with_unknowns(const Polynomial& p, const std::vector<Rational>& u) {
  Polynomial result;
  for (const auto& [term, c] : p.terms())
    result.add({term.monomial, 0},
               term.unknown == 0 ? c : Rational(c * u[static_cast<std::size_t>(term.unknown) - 1]));
  return result;
}

Polynomial substituted(const Polynomial& p, std::size_t first,
                       const std::vector<Polynomial>& values) {
  Polynomial result;
  for (const auto& [term, c] : p.terms()) {
    Monomial rest = term.monomial;
    Polynomial product(c);
    for (std::size_t k = 0; k < values.size(); ++k) {
      // x_{first+k}^e becomes values[k]^e; the other variables are a factor at the end.
      for (int e = rest.exponent(first + k); e > 0; --e) product *= values[k];
      rest = rest.without(first + k);
    }
    product *= Polynomial(Term{rest, term.unknown});
    result += product;
  }
  return result;
}

}  // namespace gainsmith::polynomial
