#include "numbers/types/real.h"

#include "numbers/dense/dense.h"
#include "numbers/dense/foundation.h"
#include "numbers/types/real_rules.h"
#include "numerics/balance.h"
#include "numerics/output_gain.h"

namespace gainsmith::numbers {

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

std::vector<int> KnownDoubles::units(const expr::Program& A, const expr::Program& C) const {
  return numerics::units(evaluate(A, values_).cwiseAbs(), evaluate(C, values_).cwiseAbs());
}

std::vector<double> KnownDoubles::output_gain(const expr::Program& A, const expr::Program& B,
                                              const expr::Program& C, bool discrete) const {
  const auto time = discrete ? numerics::Time::discrete : numerics::Time::continuous;
  const Matrix rows =
      numerics::output_gain(evaluate(A, values_), evaluate(B, values_), evaluate(C, values_), time)
          .transpose();
  return {rows.data(), rows.data() + rows.size()};
}

int numerical_rank(const Matrix& matrix, double tolerance) {
  return count_above<double>(singular_values(matrix),
                             tolerance < 0 ? rounding_of<double>(matrix) : tolerance);
}

}  // namespace gainsmith::numbers
