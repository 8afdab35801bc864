// Monomials x_1^e_1 ... x_n^e_n, in graded lexicographic order.
#pragma once

#include <compare>
#include <cstddef>
#include <string>
#include <vector>

namespace gainsmith::polynomial {

/// The exponents e_1, e_2, ... up to the last that is not 0, so that a monomial is the same in any
/// number of variables.
class Monomial {
 public:
  Monomial() = default;
  /// x_i^e, i from 0.
  explicit Monomial(std::size_t variable, int exponent = 1);
  explicit Monomial(std::vector<int> exponents);

  /// e_i, i from 0; 0 of a variable that does not occur.
  int exponent(std::size_t variable) const {
    return variable < exponents_.size() ? exponents_[variable] : 0;
  }
  /// One more than the last variable that occurs.
  std::size_t variables() const { return exponents_.size(); }
  /// e_1 + ... + e_n.
  int degree() const { return degree_; }
  /// With e_i = 0.
  Monomial without(std::size_t variable) const;

  friend Monomial operator*(const Monomial& a, const Monomial& b);
  bool operator==(const Monomial&) const = default;
  /// By degree, and then the higher powers of the first variables first: 1, x, y, x^2, x*y, y^2.
  friend std::strong_ordering operator<=>(const Monomial& a, const Monomial& b);

 private:
  /// Drops zeros at the end, and sets the degree.
  void trim();

  std::vector<int> exponents_;
  int degree_ = 0;
};

/// "x_1^2*x_2"; "1" without variables. `names` has one for each of monomial.variables().
std::string to_string(const Monomial& monomial, const std::vector<std::string>& names);

/// How many monomials in n variables have at most a degree: C(n + degree, n), as a double, which
/// has room for large ones.
double count_of_monomials(std::size_t n, int degree);

/// All monomials in n variables of a degree from `low` to `high`, in their order.
std::vector<Monomial> monomials(std::size_t n, int low, int high);

}  // namespace gainsmith::polynomial
