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
  const bool is_longer = a.variables() >= b.variables();
  Monomial result = is_longer ? a : b;
  const Monomial& other = is_longer ? b : a;
  for (std::size_t i = 0; i < other.variables(); ++i) result.exponents_[i] += other.exponents_[i];
  result.degree_ += other.degree_;
  return result;
}

bool operator<(const Monomial& a, const Monomial& b) {
  if (a.degree_ != b.degree_) return a.degree_ < b.degree_;
  return b.exponents_ < a.exponents_;
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

namespace {

/// Those of one degree whose first exponents are given, by falling powers of the next variable.
void add_of_degree(std::size_t n, int degree, std::vector<int>& exponents,
                   std::vector<Monomial>& out) {
  if (exponents.size() + 1 >= n) {
    if (n == 0 && degree > 0) return;
    if (n > 0) exponents.push_back(degree);
    out.emplace_back(exponents);
    if (n > 0) exponents.pop_back();
    return;
  }
  for (int e = degree; e >= 0; --e) {
    exponents.push_back(e);
    add_of_degree(n, degree - e, exponents, out);
    exponents.pop_back();
  }
}

}  // namespace

std::vector<Monomial> monomials(std::size_t n, int low, int high) {
  std::vector<Monomial> result;
  std::vector<int> exponents;
  for (int degree = std::max(low, 0); degree <= high; ++degree)
    add_of_degree(n, degree, exponents, result);
  return result;
}

}  // namespace gainsmith::polynomial
