// Programs as functions of one vector of doubles, in which their inputs are stacked: all of them
// are one tape (tape.h). Where something has no value they are evaluated one by one as Real does,
// which gives the value or says the fault with its place.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "expr/program/program.h"
#include "numbers/graph/tape.h"
#include "numbers/types/real.h"

namespace gainsmith::numbers {

/// Where an input that moves begins in the vector, column by column; at its size: a number that is
/// given beside it. None: it is a constant.
using PlaceOfInput = std::function<std::optional<Eigen::Index>(const std::string& name)>;

class StackedFunctions {
 public:
  /// Programs without calls, and the constants, must outlive it. `size`: of the vector.
  StackedFunctions(std::vector<const expr::Program*> programs, const PlaceOfInput& place,
                   const Values& constants, Eigen::Index size);
  StackedFunctions(StackedFunctions&&) noexcept;
  StackedFunctions& operator=(StackedFunctions&&) noexcept;
  ~StackedFunctions();

  std::size_t count() const { return programs_.size(); }

  /// Evaluates all at x, and `beside` it. False: one of them may have no value; then at() tells of
  /// each.
  bool run(const Eigen::VectorXd& x, double beside = 0);
  /// The value of the k-th in the run before, which was true; it is valid until the next call.
  const Matrix& value(std::size_t k);
  /// Its elements, column by column.
  double element(std::size_t k, std::size_t e) const { return (*tape_)(k, e); }
  /// The k-th alone, by Real. EvaluationError when an operation has no result.
  const Matrix& at(std::size_t k, const Eigen::VectorXd& x, double beside = 0);
  /// The value of the first one at x. EvaluationError when an operation has no result.
  const Matrix& operator()(const Eigen::VectorXd& x, double beside = 0) {
    return run(x, beside) ? value(0) : at(0, x, beside);
  }
  /// Bounds of all values where the elements of the vector lie anywhere in a box (Tape::enclose).
  /// False: none are known, or something may have no value there.
  bool enclose(const Box& x, double part = 0);
  /// Of element `e` of the k-th, after enclose().
  const Range& range(std::size_t k, std::size_t e) const { return tape_->range(k, e); }
  /// The elements of the vector that a program uses, in rising order.
  std::vector<Eigen::Index> elements() const;

 private:
  struct Careful;

  /// Traces all programs to one graph, and makes the tape of it.
  void make();

  std::vector<const expr::Program*> programs_;
  std::vector<std::vector<Eigen::Index>> places_;  ///< by program and input; -1: a constant
  const Values* constants_;
  Eigen::Index size_;
  std::optional<Tape> tape_;  ///< made in the first run
  std::vector<Matrix> values_;
  std::vector<std::unique_ptr<Careful>> careful_;  ///< made when they are asked for
};

}  // namespace gainsmith::numbers
