// What decides in the judge alone (more in ode/tolerances.h and hybrid/tolerances.h). One line
// each: unit | meaning | the test that fails where the value is wrong (docs/tolerances.md).
#pragma once

namespace gainsmith::judge {

constexpr double kRounding = 1e-13;  ///< relative
///< | what another order of the same operations may change
///< | Judge.FindsAWrongMap
constexpr double kFactor = 100;  ///< accuracies of the run; in one step times sqrt(n) of n elements
///< | what a recorded flow may differ by from the one that is integrated again
///< | Judge.FindsAFlowThatIsOff
constexpr double kCertain = 0.1;  ///< of what is allowed
///< | the error of the flow that is integrated again
///< | Judge.IntegratesLongAndStiffSteps
constexpr int kMostParts = 256;  ///< Gauss steps
///< | in no more parts one recorded step is integrated again
///< | Judge.IntegratesLongAndStiffSteps

}  // namespace gainsmith::judge
