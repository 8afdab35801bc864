// Internal to the judge (judge.h): whether the end of a run has the cause that it names.
//
//   horizon      the horizon is the last time
//   left         a condition under `while` is false there
//   passes       the event that is due has a loop whose `until` does not become true
//   undefined    a text has no value there, or where the flow leads at once
//   stuck        many jumps without a flow between them
//   escaped      a value is no number or large, or changes in no time
//   zeno         the last lengths shrink by a steady factor, the accumulation point follows
//   chattering   the last flows are short
//   sliding      along the flow the rate is another one at once
// `full`, `interrupted` and `lost` say nothing that could be checked.
#pragma once

#include <Eigen/Core>

#include "hybrid/trajectory.h"
#include "judge/faults.h"
#include "judge/texts.h"

namespace gainsmith::judge {

/// `x`: the last values.
void check_end(Texts& texts, const hybrid::Trajectory& trajectory, const Eigen::VectorXd& x,
               Faults& faults);

}  // namespace gainsmith::judge
