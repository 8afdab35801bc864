// How far an iterate is from satisfying the equations, in working and in original units.
#pragma once

#include "sdp/core/iterate.h"
#include "sdp/core/presolve.h"

namespace gainsmith::sdp {

/// The defect of an iterate and the errors that stopping checks.
template <typename T>
class Residuals {
 public:
  Residuals(const Problem& problem, const Presolved& presolved);

  /// Computes all members at `point`; A(Y) and A*(x) in T, the measures in double.
  void update(const Iterate<T>& point);

  Defect<T> defect;

  /// Of (x, X, Y)/tau on the original, unscaled problem.
  double primal_objective = 0;      ///< c'x
  double dual_objective = 0;        ///< F_0.Y
  double gap = 0;                   ///< (primal - dual) / (1 + |primal| + |dual|)
  double complementarity = 0;       ///< X.Y / (1 + |primal| + |dual|)
  double primal_infeasibility = 0;  ///< ||sum x_i F_i - F_0 - X||_F / (1 + max|F_0|)
  double dual_infeasibility = 0;    ///< ||F_i.Y - c_i|| / (1 + max|c|)
  /// What rounding alone does to the two: epsilon times the numbers that cancel in them, sum_i
  /// |x_i| ||F_i|| (to a factor of 2) and ||Y||.
  double primal_rounding = 0;
  double dual_rounding = 0;
  /// By how much infeasibility may move the objectives, relative as the gap: with (x, Y) in place
  /// of the solution, sum_i |x_i| |F_i.Y - c_i| + sum_b ||(sum x_i F_i - F_0 - X)_b|| ||Y_b|| over
  /// the blocks b of the working problem.
  double objective_error = 0;

  /// Of Y and x as directions, on the original problem (see Certificate); infinite when the sign is
  /// wrong: sum_i |F_i.Y| / F_0.Y, and ||(sum x_i F_i)_-|| / -c'x bounded by ||R|| + tau ||F_0||.
  double primal_certificate = 0;
  double dual_certificate = 0;

  /// A dual defect of this norm, in working units and at tau = 1, has a dual infeasibility of 1 at
  /// most.
  double dual_unit() const { return dual_unit_; }

  /// The largest of the errors of the point.
  double worst() const;

 private:
  const Presolved& presolved_;
  double largest_c_, largest_f0_, norm_f0_, dual_unit_;  ///< max|c|, max|F_0|, ||F_0||_F
  Vector<T> products_;
};

}  // namespace gainsmith::sdp
