// Numbers and matrices without rounding, written as decimals: what is planted holds for the file.
#pragma once

#include <boost/multiprecision/cpp_int.hpp>
#include <string>
#include <vector>

namespace gainsmith::tests::properties {

/// A rational whose denominator is a product of twos and fives.
using Exact = boost::multiprecision::number<boost::multiprecision::cpp_rational_backend,
                                            boost::multiprecision::et_off>;

/// 10^exponent, 2^exponent.
Exact ten_to(int exponent);
Exact two_to(int exponent);

/// The whole decimal: "-1234e-6".
std::string decimal(const Exact& value);

class ExactMatrix {
 public:
  ExactMatrix() = default;
  ExactMatrix(int rows, int columns)
      : rows_(rows), columns_(columns), elements_(static_cast<std::size_t>(rows * columns)) {}
  static ExactMatrix identity(int n);
  static ExactMatrix diagonal(const std::vector<Exact>& elements);

  int rows() const { return rows_; }
  int columns() const { return columns_; }
  Exact& operator()(int i, int j) { return elements_[static_cast<std::size_t>(i * columns_ + j)]; }
  const Exact& operator()(int i, int j) const {
    return elements_[static_cast<std::size_t>(i * columns_ + j)];
  }
  ExactMatrix transpose() const;
  /// The rows [first, first + count).
  ExactMatrix top(int count) const;

 private:
  int rows_ = 0;
  int columns_ = 0;
  std::vector<Exact> elements_;
};

ExactMatrix operator*(const ExactMatrix& a, const ExactMatrix& b);
ExactMatrix operator*(const Exact& a, const ExactMatrix& b);
ExactMatrix operator+(const ExactMatrix& a, const ExactMatrix& b);

/// The sum of the products of all elements.
Exact trace_product(const ExactMatrix& a, const ExactMatrix& b);

/// As a problem file writes it: "[[1, 2e-3], [0, 1]]".
std::string yaml(const ExactMatrix& matrix);

}  // namespace gainsmith::tests::properties
