// The tolerances of this room, some of which the rooms above share: unit | meaning | test.
#pragma once

#include <cstddef>
#include <cstdint>

namespace gainsmith::bounded {

// clang-format off
constexpr double kBoundSlack = 1 + 1e-9;  ///< factor | bounds of errors are summed in double
        ///< without directed rounding and then widened by this | Balls.BoundsOfLongSumsHold
constexpr double kFunctionRounding = 8;  ///< units in the last place | the rounding of exp, log,
        ///< sin, cos, tanh and pow | Balls.HoldTheValueInHundredDigits
constexpr double kExponentialError = 0x1p-80;  ///< of e^norm | the error of a matrix exponential in
        ///< 31 digits, with a wide margin | Balls.HoldTheValueInHundredDigits
constexpr double kCoefficientNoise = 1e-80;  ///< of the largest coefficient | a coefficient in 100
        ///< digits below it is 0 | CoordinatesTest.LeaveOutWhatNoClaimDependsOn
constexpr std::size_t kMostWords = 2000;  ///< words | a text that expands to a longer polynomial is
        ///< judged as it is written | PolynomialTest.IsTheFunctionOfItsText
constexpr int kFewestLevels = 3;  ///< powers of two | the longest interval of an affine flow has at
        ///< least 2^3 steps, and the first of them are up to 2^3 times shorter |
        ///< FlowSteps.LengthsAddUpAndResolveTheInterval
constexpr int kMostLevels = 40;  ///< powers of two | a flow whose matrix times the longest interval
        ///< exceeds 2^40 is refused as too fast | FlowSteps.RefusesFlowsThatAreNoNumbersOrTooFast
constexpr std::int64_t kMostJumps = 1000000;  ///< jumps | a run with more of them ends at the jump
        ///< limit | SampledRun.IntervalsThatShrinkToNothingHitTheJumpLimit
constexpr std::size_t kStepsOfBox = 8;  ///< steps | new errors are bounded element by element so
        ///< long before they join the ellipsoid | BoundedRun.StiffFlowsAndConstantsToo
constexpr int kPartsOfFlow = 32;  ///< parts | claims are compared at the ends of so many equal
        ///< parts of an integrated flow | ClockedRun.SharesFlowsThatAreLinearButForClocks
constexpr double kSharper = 1e-2;  ///< of the accuracy | the accuracy of the second run, whose
        ///< difference from the first one shows the error |
        ///< ClockedRun.BoundsHoldTheErrorOfAClosedForm
constexpr double kErrorOfDifference = 4;  ///< factor | the error of the sharper of two runs, of
        ///< their difference | ClockedRun.BoundsHoldTheErrorOfAClosedForm
constexpr int kSamplesBeside = 2;  ///< samples on each side | the difference of two runs at a
        ///< sample is the largest among these, since the runs may cross |
        ///< ClockedRun.SharesFlowsThatAreLinearButForClocks
constexpr double kLeastColumn = 1e-4;  ///< of the first columns | a column of a shared flow that
        ///< decays below it is integrated to an absolute error |
        ///< ClockedRun.FollowsADecayOverManyDecades
constexpr std::size_t kMostPieces = 10000;  ///< pieces | a flow that needs more, with those that
        ///< were halved, is not shared: every run integrates its own |
        ///< ClockedRun.SharesNoOtherFlows
// clang-format on

}  // namespace gainsmith::bounded
