#include "polynomial/monomial.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace gainsmith::polynomial {

Monomial::Monomial(std::size_t variable, int exponent) : exponents_(variable + 1) {
  exponents_[variable] = exponent;
  trim();
}

Monomial::Monomial(std::vector<int> exponents) : exponents_(std::move(exponents)) { trim(); }

void Monomial::trim() {
  while (!exponents_.empty() && exponents_.back() == 0) exponents_.pop_back();
  degree_ = std::accumulate(exponents_.begin(), exponents_.end(), 0);
}

Monomial Monomial::without(std::size_t variable) const {
  Monomial result = *this;
  if (variable < result.exponents_.size()) result.exponents_[variable] = 0;
  result.trim();
  return result;
}

Monomial operator*(const Monomial& a, const Monomial& b) {
  if (a.variables() < b.variables()) return b * a;
  Monomial result = a;
  for (std::size_t i = 0; i < b.variables(); ++i) result.exponents_[i] += b.exponents_[i];
  result.degree_ += b.degree_;
  return result;
}

std::strong_ordering operator<=>(const Monomial& a, const Monomial& b) {
  return a.degree_ != b.degree_ ? a.degree_ <=> b.degree_ : b.exponents_ <=> a.exponents_;
}

std::string to_string(const Monomial& monomial, const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < monomial.variables(); ++i) {
    const int e = monomial.exponent(i);
    if (e == 0) continue;
    text += (text.empty() ? "" : "*") + names[i] + (e > 1 ? "^" + std::to_string(e) : "");
  }
  return text.empty() ? "1" : text;
}

double count_of_monomials(std::size_t n, int degree) {
  double count = 1;
  for (std::size_t i = 1; i <= n; ++i)
    count *= (degree + static_cast<double>(i)) / static_cast<double>(i);
  return count;
}

std::vector<Monomial> monomials(std::size_t n, int low, int high) {
  std::vector<Monomial> result, of_degree = {Monomial()};
  for (int degree = 0; degree <= high; ++degree) {
    if (degree >= low) result.insert(result.end(), of_degree.begin(), of_degree.end());
    std::vector<Monomial> next;
    for (const Monomial& m : of_degree)
      // Each monomial of the next degree comes once: times its last variable, or one behind.
      for (std::size_t i = std::max<std::size_t>(m.variables(), 1) - 1; i < n; ++i)
        next.push_back(m * Monomial(i));
    of_degree = std::move(next);
  }
  return result;
}

}  // namespace gainsmith::polynomial
