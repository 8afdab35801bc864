// The parts of a run beside those of its second run, called twin in names: two runs of one (seed,
// number) that differ in accuracy and rounding.
//
// Both may have the same events at one instant in another order, or with a flow of hardly any
// length between them. Then the jumps of the second run are taken again in the order of the first,
// from the values of the second before them. Events that do not touch each other are the same in
// any order; what others do shows in the values. A chain of jumps that is longer in one run is
// paired in this manner too.
//
// The difference of two runs to two accuracies estimates the error of the worse one. It is no
// bound: error_factor leaves a margin.
#pragma once

#include <Eigen/Core>
#include <variant>
#include <vector>

#include "claims/tolerances.h"
#include "hybrid/system.h"
#include "hybrid/trajectory.h"
#include "simulate/jump_maps.h"

namespace gainsmith::claims {

/// Times the difference of two runs: the error of the sharper one.
inline double error_factor(const hybrid::System& system) {
  return system.affine ? kErrorOfRounding : kErrorOfDifference;
}

/// factor |run - twin| + 8 u |run|, element by element; 0 of what is the same whole number in both.
Eigen::VectorXd errors_of(const Eigen::VectorXd& run, const Eigen::VectorXd& twin, double factor);

/// A flow of the run, and that of the second run beside it.
struct TwinFlow {
  const hybrid::FlowPiece* flow = nullptr;
  const hybrid::FlowPiece* twin = nullptr;  ///< none within an instant: it stays as it is
  Eigen::VectorXd stays;

  /// Values of the second run at a share of the flow, in [0, 1].
  Eigen::VectorXd twin_at(double share) const;
};

/// A jump of the run, and what the second run has just before and after it.
struct TwinJump {
  const hybrid::JumpPoint* jump = nullptr;
  Eigen::VectorXd twin_before, twin_after;
  double twin_t = 0;
};

struct TwinParts {
  std::vector<std::variant<TwinFlow, TwinJump>> parts;
  bool whole = false;  ///< false: from there on they have other events
};

/// The common parts, in the order of `run`. Both trajectories must outlive them.
TwinParts pair_twins(const hybrid::Trajectory& run, const hybrid::Trajectory& twin,
                     const hybrid::System& system, simulate::JumpMaps& maps);

}  // namespace gainsmith::claims
