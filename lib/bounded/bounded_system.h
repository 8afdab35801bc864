// A system in the coordinates of a judgement over Scalar, with error bounds: what all its runs
// share.
#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bounded/step_maps.h"

namespace gainsmith::bounded {

template <class Scalar>
using BallsOf = std::map<std::string, Ball<Scalar>, std::less<>>;

/// A program over balls as a function of (x, tau). Everything given must outlive it.
template <class Scalar>
class BallFunction {
 public:
  BallFunction(const expr::Program& program, const hybrid::StateLayout& layout,
               const BallsOf<Scalar>& constants);
  BallFunction(BallFunction&&) noexcept = default;
  BallFunction& operator=(BallFunction&&) noexcept = default;

  const Ball<Scalar>& operator()(const Eigen::Ref<const ColumnOf<Scalar>>& x,
                                 const Eigen::Ref<const Eigen::VectorXd>& r, const Scalar& tau,
                                 double tau_bound);

 private:
  std::vector<hybrid::Slot> slots_;  ///< those that the program uses
  std::vector<Ball<Scalar>> moving_;
  expr::Evaluator<BallAlgebra<Scalar>> evaluator_;
};

/// The jump as an affine map; none when a coefficient depends on clocks or an entry is not affine.
std::optional<WideMap> affine_jump(const Coordinates& coordinates);

/// What the runs of one Scalar share.
template <class Scalar>
struct BoundedSystem {
  /// `exact`: of an affine flow; others have no steps.
  BoundedSystem(const Coordinates& coordinates, const std::optional<ExactSteps>& exact);

  const Coordinates* coordinates;
  BallsOf<Scalar> constants;
  StepMaps<Scalar> steps;
  std::optional<BoundedMap<Scalar>> jump;  ///< when it is affine with constant coefficients
  std::vector<bool> linear_jump;           ///< of each coordinate: affine, with clocks as numbers
};

}  // namespace gainsmith::bounded
