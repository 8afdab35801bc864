// Texts of a System in 31 digits, where each number of a text enters as its decimals.
//
// 31 digits are pairs of doubles (double-double). Evaluation is operation by operation, without
// code that is compiled.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "base/eigen_scalars.h"
#include "expr/program/evaluate.h"
#include "hybrid/system.h"
#include "numbers/types/real.h"

namespace gainsmith::simulate {

using Values31 = Eigen::Matrix<DoubleDouble, Eigen::Dynamic, 1>;
using Matrix31 = numbers::MatrixOf<DoubleDouble>;
using Constants31 = numbers::ValuesOf<DoubleDouble>;

/// The nearest doubles: the leading parts.
inline Eigen::VectorXd rounded(const Values31& x) {
  return x.unaryExpr([](const DoubleDouble& number) { return number.hi(); });
}

class Function31 {
 public:
  /// All must outlive it. std::logic_error where a constant is missing.
  Function31(const expr::Program& program, const hybrid::System& system,
             const Constants31& constants);

  /// Of the values of a System, all of them; valid until the next call. EvaluationError when an
  /// operation has no result.
  const Matrix31& operator()(const Values31& values);

 private:
  struct Input {
    Eigen::Index offset = 0;
    Matrix31 value;
  };
  std::vector<Input> inputs_;
  expr::Evaluator<numbers::Real<DoubleDouble>> evaluator_;
};

}  // namespace gainsmith::simulate
