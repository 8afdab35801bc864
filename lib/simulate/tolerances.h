// What decides in the simulator alone (more in ode/tolerances.h and hybrid/tolerances.h). One line
// each: unit | meaning | the test that fails where the value is wrong (docs/tolerances.md).
#pragma once

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

}  // namespace gainsmith::simulate
