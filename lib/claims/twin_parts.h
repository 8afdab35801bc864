// The parts of a run beside those of its twin: two runs of one (seed, number) that differ in
// accuracy and rounding.
//
// Both may have the same events at one instant in another order, or with a flow of hardly any
// length between them. Then the twin's jumps are taken again in the order of the run, from the
// twin's values before the first of them. Events that do not touch each other are the same in any
// order; what others do shows in the values. A chain of jumps that is longer in one run is paired
// in this manner too.
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

/// What values of a run may be off by, where those of its twin are known: of the difference, and what
/// rounds. What is a whole number in both is exact.
Eigen::VectorXd errors_of(const Eigen::VectorXd& run, const Eigen::VectorXd& twin, double factor);

struct TwinFlow {
  const hybrid::FlowPiece* flow = nullptr;
  const hybrid::FlowPiece* twin = nullptr;  ///< none within an instant: it stays as it is
  Eigen::VectorXd stays;

  /// The twin's values at a share of the flow.
  Eigen::VectorXd twin_at(double share) const;
};

struct TwinJump {
  const hybrid::JumpPoint* jump = nullptr;
  Eigen::VectorXd twin_before, twin_after;
  double twin_t = 0;
};

struct TwinParts {
  std::vector<std::variant<TwinFlow, TwinJump>> parts;
  bool whole = false;  ///< false: from there on they have other events
};

TwinParts pair_twins(const hybrid::Trajectory& run, const hybrid::Trajectory& twin,
                     const hybrid::System& system, simulate::JumpMaps& maps);

}  // namespace gainsmith::claims
