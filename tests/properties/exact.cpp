#include "properties/exact.h"

#include <cstdlib>
#include <stdexcept>

namespace gainsmith::tests::properties {

using Integer = boost::multiprecision::number<boost::multiprecision::cpp_int_backend<>,
                                              boost::multiprecision::et_off>;

namespace {

Exact power(int base, int exponent) {
  const Integer whole =
      boost::multiprecision::pow(Integer(base), static_cast<unsigned>(std::abs(exponent)));
  return exponent < 0 ? Exact(Integer(1), whole) : Exact(whole);
}

}  // namespace

Exact ten_to(int exponent) { return power(10, exponent); }
Exact two_to(int exponent) { return power(2, exponent); }

std::string decimal(const Exact& value) {
  Integer top = boost::multiprecision::numerator(value);
  Integer bottom = boost::multiprecision::denominator(value);
  if (top == 0) return "0";
  int exponent = 0;
  while (bottom % 2 == 0) bottom /= 2, top *= 5, --exponent;
  while (bottom % 5 == 0) bottom /= 5, top *= 2, --exponent;
  if (bottom != 1) throw std::logic_error("no decimal");
  while (top % 10 == 0) top /= 10, ++exponent;
  return top.str() + (exponent == 0 ? "" : "e" + std::to_string(exponent));
}

ExactMatrix ExactMatrix::identity(int n) {
  return diagonal(std::vector<Exact>(static_cast<std::size_t>(n), Exact(1)));
}

ExactMatrix ExactMatrix::diagonal(const std::vector<Exact>& elements) {
  const int n = static_cast<int>(elements.size());
  ExactMatrix result(n, n);
  for (int i = 0; i < n; ++i) result(i, i) = elements[static_cast<std::size_t>(i)];
  return result;
}

ExactMatrix ExactMatrix::transpose() const {
  ExactMatrix result(columns_, rows_);
  for (int i = 0; i < rows_; ++i)
    for (int j = 0; j < columns_; ++j) result(j, i) = (*this)(i, j);
  return result;
}

ExactMatrix ExactMatrix::top(int count) const {
  ExactMatrix result(count, columns_);
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < columns_; ++j) result(i, j) = (*this)(i, j);
  return result;
}

ExactMatrix operator*(const ExactMatrix& a, const ExactMatrix& b) {
  ExactMatrix result(a.rows(), b.columns());
  for (int i = 0; i < a.rows(); ++i)
    for (int j = 0; j < b.columns(); ++j)
      for (int k = 0; k < a.columns(); ++k)
        if (a(i, k) != 0 && b(k, j) != 0) result(i, j) += a(i, k) * b(k, j);
  return result;
}

ExactMatrix operator*(const Exact& a, const ExactMatrix& b) {
  ExactMatrix result = b;
  for (int i = 0; i < b.rows(); ++i)
    for (int j = 0; j < b.columns(); ++j) result(i, j) *= a;
  return result;
}

ExactMatrix operator+(const ExactMatrix& a, const ExactMatrix& b) {
  ExactMatrix result = a;
  for (int i = 0; i < b.rows(); ++i)
    for (int j = 0; j < b.columns(); ++j) result(i, j) += b(i, j);
  return result;
}

Exact trace_product(const ExactMatrix& a, const ExactMatrix& b) {
  Exact sum = 0;
  for (int i = 0; i < a.rows(); ++i)
    for (int j = 0; j < a.columns(); ++j) sum += a(i, j) * b(i, j);
  return sum;
}

std::string yaml(const ExactMatrix& matrix) {
  std::string text = "[";
  for (int i = 0; i < matrix.rows(); ++i) {
    text += i > 0 ? ", [" : "[";
    for (int j = 0; j < matrix.columns(); ++j) text += (j > 0 ? ", " : "") + decimal(matrix(i, j));
    text += "]";
  }
  return text + "]";
}

}  // namespace gainsmith::tests::properties
