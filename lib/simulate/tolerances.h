// What decides in the simulator alone (more in ode/tolerances.h and hybrid/tolerances.h). One line
// each: unit | meaning | the test that fails where the value is wrong (docs/tolerances.md).
#pragma once

#include <cstdint>

namespace gainsmith::simulate {

constexpr double kEarly = 0.1;  ///< of a step
///< | an event so early is found again on a shorter step, whose rounding is smaller
///< | EventRun.ZenoStopsAtItsAccumulation
constexpr double kShorterStep = 1.5;  ///< times the length up to an event
///< | the length of that shorter step; of the first step of an exact flow, by the flow before
///< | EventRun.ZenoStopsAtItsAccumulation
constexpr double kNearOfTerms = 1e-3;  ///< of the sizes of the terms of a guard
///< | turning points as near to 0 as that are compared with their errors
///< | EventRun.ATwinKeepsTurningPointsNextToZero
constexpr double k31Residual = 1e-24;  ///< relative
///< | stages of a step in 31 digits are corrected for the last time when they are off by less
///< | State31.FollowsChaos
constexpr double k31Solved = 1e-27;  ///< relative
///< | a time, or a guard of its terms, that is known in 31 digits
///< | State31.FollowsEventsOfFlows
constexpr double k31Terms = 1e-15;  ///< of what moves
///< | the last terms of a step in 31 digits: its end, of twice the order, is off by their square
///< | State31.FollowsChaos
constexpr double k31Least = 1e-12;  ///< of the largest value so far
///< | values in 31 digits that have never been larger are known as if they had been
///< | State31.DecaysInLongSteps
constexpr double k31Near = 1e-11;  ///< of the terms of a guard
///< | an event that is found in double has happened where its guard is so near to 0
///< | State31.FollowsEventsOfFlows
constexpr std::int64_t k31Steps = 1000;  ///< steps of a run of ten states; of more fewer
///< | one that needs more is not made in 31 digits
///< | State31.EndsWhereStepsAreMany

}  // namespace gainsmith::simulate
