// Polynomials in x_1, x_2, ... whose coefficients are affine in unknowns u_1, u_2, ..., with
// fractions for numbers:
//   p(x; u) = sum over monomials m of (c_m0 + sum_k c_mk u_k) m(x).
//
// The room is the exact arithmetic beneath sums of squares: nothing is rounded, so two texts of one
// polynomial give the same terms. A product of two unknowns has no such form and is refused.
//   monomial              exponents, their order, all monomials of some degrees
//   polynomial            sums, products, derivatives, substitution
//   polynomial_numbers    matrices of them as the values of a program
#pragma once

#include <cstddef>
#include <map>
#include <stdexcept>

#include "base/rational.h"
#include "polynomial/monomial.h"

namespace gainsmith::polynomial {

/// A monomial in x and an unknown, counted from 1; 0 is the constant 1.
struct Term {
  Monomial monomial;
  int unknown = 0;

  auto operator<=>(const Term&) const = default;
};

/// Thrown for a product of u_first and u_second, which is not affine in the unknowns.
struct ProductOfUnknowns : std::logic_error {
  ProductOfUnknowns(int a, int b) : logic_error("a product of unknowns"), first(a), second(b) {}
  int first, second;
};

/// A sum of terms; 0 has none.
class Polynomial {
 public:
  Polynomial() = default;
  Polynomial(int number) : Polynomial(Rational(number)) {}  // NOLINT: a scalar of Eigen
  Polynomial(const Rational& number) {                      // NOLINT
    add(Term{}, number);
  }
  /// A polynomial of one term with the coefficient 1.
  explicit Polynomial(const Term& term) : terms_{{term, Rational(1)}} {}

  /// No coefficient is 0.
  const std::map<Term, Rational>& terms() const { return terms_; }
  bool is_number() const;
  /// Of one that is a number.
  Rational number() const { return terms_.empty() ? Rational(0) : terms_.begin()->second; }
  /// An unknown that occurs, from 1; 0 where none does.
  int unknown() const;
  /// The highest degree in x; of 0 it is 0.
  int degree() const;
  /// The number of variables up to the last that occurs.
  std::size_t variables() const;

  /// A term whose coefficient becomes 0 is removed.
  void add(const Term& term, const Rational& coefficient);
  Polynomial& add(const Polynomial& other, const Rational& factor);

  Polynomial& operator+=(const Polynomial& b) { return add(b, 1); }
  Polynomial& operator-=(const Polynomial& b) { return add(b, -1); }
  Polynomial& operator*=(const Rational& factor);
  friend Polynomial operator+(Polynomial a, const Polynomial& b) { return a += b; }
  friend Polynomial operator-(Polynomial a, const Polynomial& b) { return a -= b; }
  friend Polynomial operator-(Polynomial a) { return a *= Rational(-1); }
  /// ProductOfUnknowns where both have an unknown.
  friend Polynomial operator*(const Polynomial& a, const Polynomial& b);
  Polynomial& operator*=(const Polynomial& b) { return *this = *this * b; }
  bool operator==(const Polynomial&) const = default;

 private:
  std::map<Term, Rational> terms_;  ///< by monomial, then by unknown
};

/// dp/dx_i, i from 0.
Polynomial derivative(const Polynomial& p, std::size_t variable);

/// p with the number u[k - 1] for unknown k; what is left has no unknown.
Polynomial with_unknowns(const Polynomial& p, const std::vector<Rational>& u);

/// p with polynomials for the variables first, first + 1, ...: one for each value; those behind
/// stay. ProductOfUnknowns where a value brings a second unknown into a term.
Polynomial substituted(const Polynomial& p, std::size_t first,
                       const std::vector<Polynomial>& values);

}  // namespace gainsmith::polynomial
