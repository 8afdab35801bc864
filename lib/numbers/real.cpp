#include "numbers/real.h"

#include <numbers>
#include <optional>

#include "base/number.h"
#include "numbers/dense.h"
#include "numbers/real_rules.h"

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

template struct Real<double>;
template Matrix evaluate<double>(const expr::Program&, const Values&);

Matrix evaluate(const expr::Program& program, const Values& values) {
  return evaluate<double>(program, values);
}

double KnownDoubles::number(const expr::Program& program) const {
  return evaluate(program, values_)(0, 0);
}

int KnownDoubles::rank(const expr::Program& matrix, const expr::Program* tolerance) const {
  return numerical_rank(evaluate(matrix, values_), tolerance != nullptr ? number(*tolerance) : -1);
}

int numerical_rank(const Matrix& matrix, double tolerance) {
  return count_above<double>(singular_values(matrix),
                             tolerance < 0 ? rounding_of<double>(matrix) : tolerance);
}

}  // namespace gainsmith::numbers
