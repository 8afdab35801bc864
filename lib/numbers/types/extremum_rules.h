// Internal to numbers: extrema over boxes, instantiated by one source a scalar.
#pragma once

#include <algorithm>
#include <string>
#include <type_traits>
#include <vector>

#include "base/number.h"
#include "expr/program/evaluate.h"
#include "numbers/types/extremum.h"
#include "numbers/types/real_rules.h"

namespace gainsmith::numbers {

/// The body of an extremum with what its inputs are, all but the names of the box. Operands: for
/// each name its low and high end, then the others; attributes[1] names. low and high hold the ends
/// of all names, stacked column by column. EvaluationError where low > high.
template <class Scalar>
class OverBox {
 public:
  using M = MatrixOf<Scalar>;

  OverBox(const expr::Instruction& instruction, expr::Operands<M> operands)
      : instruction_(instruction),
        variables_(static_cast<std::size_t>(instruction.attributes[1])),
        evaluator_(*instruction.body) {
    for (std::size_t k = 0; k < variables_.size(); ++k) {
      variables_[k] = *operands[2 * k];
      append(low, *operands[2 * k]);
      append(high, *operands[2 * k + 1]);
      evaluator_.set(expr::variable_name(k), variables_[k]);
    }
    for (std::size_t k = 2 * variables_.size(); k < operands.size(); ++k)
      evaluator_.fix(expr::other_name(k - 2 * variables_.size()), *operands[k]);
    for (Eigen::Index i = 0; i < low.size(); ++i)
      if (low(i) > high(i))
        throw expr::EvaluationError(
            std::string(instruction.attributes[0] != 0 ? "maximum" : "minimum") + ": the box of " +
            instruction.text + " is empty: " + brief(static_cast<double>(low(i)), 17) + " > " +
            brief(static_cast<double>(high(i)), 17));
  }

  /// f at the elements of the names, column by column.
  Scalar at(const Eigen::Matrix<Scalar, Eigen::Dynamic, 1>& x) {
    Eigen::Index first = 0;
    for (M& variable : variables_) {
      variable.reshaped() = x.segment(first, variable.size());
      first += variable.size();
    }
    try {
      return evaluator_.run()(0, 0);
    } catch (const expr::EvaluationError& error) {
      throw expr::EvaluationError(error.place(), error.message() + ", at " + named_point());
    }
  }

  Eigen::Matrix<Scalar, Eigen::Dynamic, 1> low, high;

 private:
  static void append(Eigen::Matrix<Scalar, Eigen::Dynamic, 1>& to, const M& matrix) {
    const Eigen::Index before = to.size();
    to.conservativeResize(before + matrix.size());
    to.tail(matrix.size()) = matrix.reshaped();
  }

  /// "x = [1; 2], u = 3"
  std::string named_point() const {
    std::string text;
    std::size_t begin = 0;
    for (const M& variable : variables_) {
      const std::size_t end =
          std::min(instruction_.text.find(' ', begin), instruction_.text.size());
      text += (text.empty() ? "" : ", ") + instruction_.text.substr(begin, end - begin) + " = ";
      begin = end + 1;
      const bool bare = variable.size() == 1;
      if (!bare) text += "[";
      for (Eigen::Index i = 0; i < variable.rows(); ++i)
        for (Eigen::Index j = 0; j < variable.cols(); ++j) {
          if (i + j > 0) text += j == 0 ? "; " : ", ";
          text += brief(static_cast<double>(variable(i, j)), 17);
        }
      if (!bare) text += "]";
    }
    return text;
  }

  const expr::Instruction& instruction_;
  std::vector<M> variables_;
  expr::Evaluator<Real<Scalar>> evaluator_;
};

/// The point of the box at which f, or -f, is found to be largest in double.
Vector extreme_point(const expr::Instruction& instruction, expr::Operands<Matrix> operands,
                     OverBox<double>& plain);

/// 1 x 1. Double searches; in more digits f is evaluated at the point that was found, with exact
/// ends of the box for rounded ones.
template <class Scalar>
MatrixOf<Scalar> extremum(const expr::Instruction& instruction,
                          expr::Operands<MatrixOf<Scalar>> operands) {
  OverBox<Scalar> exact(instruction, operands);
  if constexpr (std::is_same_v<Scalar, double>) {
    return Matrix::Constant(1, 1, exact.at(extreme_point(instruction, operands, exact)));
  } else {
    std::vector<Matrix> rounded;
    for (const MatrixOf<Scalar>* operand : operands)
      rounded.push_back(operand->unaryExpr([](const Scalar& x) { return static_cast<double>(x); }));
    std::vector<const Matrix*> pointers;
    for (const Matrix& matrix : rounded) pointers.push_back(&matrix);
    OverBox<double> plain(instruction, pointers);
    const Vector found = extreme_point(instruction, pointers, plain);
    Eigen::Matrix<Scalar, Eigen::Dynamic, 1> x = exact.low;
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      const double at = found(i);
      if (at == plain.high(i))
        x(i) = exact.high(i);
      else if (at != plain.low(i))
        x(i) = Scalar(at);
    }
    return MatrixOf<Scalar>::Constant(1, 1, exact.at(x));
  }
}

}  // namespace gainsmith::numbers
