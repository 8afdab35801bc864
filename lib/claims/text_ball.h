// Errors of a text in double, by enclosures (numbers/types/enclosure.h): what its evaluation
// rounds, and what errors of the variables make of it where it branches. Two runs that are compared
// do not show either: they round alike, and may both take the wrong branch.
//
// An enclosure is a mid and a radius for each element: the true value lies in [mid - rad, mid +
// rad] for all variables in [x - r, x + r]. `where`, `max` and `min` with an uncertain branch give
// the hull of both branches.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "base/error.h"
#include "claims/run_values.h"
#include "claims/track.h"
#include "numbers/types/enclosure.h"

namespace gainsmith::claims {

/// Constants with their errors: what is no whole number counts as rounded once, as decimals are.
numbers::EnclosedValues<double> rounded_once(const numbers::Values& constants);

/// Of a number as a function of all variables. All arguments must outlive it.
class TextBall {
 public:
  /// `value` is the program as a function.
  TextBall(const expr::Program& program, RunValue& value, const hybrid::StateLayout& layout,
           const numbers::EnclosedValues<double>& constants);

  /// How far the computed value may be from the true one at x; 0 where no bound is known.
  double rounding(const Eigen::VectorXd& x);

  /// Whether it is uncertain which branch is taken when the variables may be off by r. An estimate
  /// decides where no bound is known.
  bool is_open(const Eigen::VectorXd& x, const Eigen::VectorXd& r);
  /// All values that it may have then; infinite where no bound is known.
  Bounded hull(const Eigen::VectorXd& x, const Eigen::VectorXd& r);

 private:
  using Enclosed = numbers::Enclosed<double>;

  /// A program as a function of the variables, each known up to an error.
  class Function {
   public:
    Function(const expr::Program& program, const hybrid::StateLayout& layout,
             const numbers::EnclosedValues<double>& constants);
    /// InputError where no bound is known.
    const Enclosed& operator()(const Eigen::VectorXd& x, const Eigen::VectorXd& r);

   private:
    std::vector<hybrid::Slot> slots_;  ///< those that the program uses
    std::vector<Enclosed> moving_;
    expr::Evaluator<numbers::Enclosure<double>> evaluator_;
    std::optional<InputError> fault_;  ///< of what is made of constants alone
  };

  bool is_open(std::size_t k, const Eigen::VectorXd& x, const Eigen::VectorXd& r);

  RunValue* value_;
  Function function_;
  std::vector<Function> differences_;
  Eigen::VectorXd exact_;
};

}  // namespace gainsmith::claims
