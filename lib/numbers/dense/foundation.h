// Internal to numbers: what Real and Enclosure need of double (real_rules.h).
#pragma once

#include <numbers>
#include <optional>
#include <string>

#include "base/number.h"
#include "numbers/dense/dense.h"
#include "numbers/types/real_rules.h"

namespace gainsmith::numbers {

template <>
struct Foundation<double> {
  static std::optional<double> parse(const std::string& decimal) { return parse_decimal(decimal); }
  static std::optional<double> pi() { return std::numbers::pi; }
  static double least_condition() { return 1e-15; }
  static Inverse inverse(const Matrix& M) { return numbers::inverse(M); }
  static Vector singular_values(const Matrix& M) { return numbers::singular_values(M); }
  static Svd full_svd(const Matrix& M) { return numbers::full_svd(M); }
  static Matrix exponential(const Matrix& M) { return numbers::exponential(M); }
};

}  // namespace gainsmith::numbers
