// Internal to the judge (judge.h): jumps, computed again from the texts.
//
//   x+ = reactions of the event's components, each from x before the jump; what none sets is kept
//
// A value may differ by kRounding times the largest term of its text, and a symmetric state by the
// asymmetry of its map besides.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "hybrid/trajectory.h"
#include "judge/faults.h"
#include "judge/texts.h"

namespace gainsmith::judge {

struct JumpValues {
  Eigen::VectorXd after;
  /// What each element may be off: 0 of what keeps its bits, infinite of what is drawn.
  Eigen::VectorXd slack;
  std::int64_t passes = 0;  ///< of all loops together
  bool exhausted = false;   ///< a loop whose `until` did not become true
};

/// The values after a jump of the event. `before` has the noise that is drawn at it.
/// EvaluationError when a map has no value.
JumpValues jump_values(Texts& texts, std::size_t event, bool lost, const Eigen::VectorXd& before);

/// Faults of a recorded jump: other values, a mode that is no whole number, a state that is not
/// symmetric.
void check_jump(Texts& texts, std::size_t part, const hybrid::JumpPoint& jump, Faults& faults);

}  // namespace gainsmith::judge
