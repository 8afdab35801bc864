// What decides in runs, for every room that makes or judges them. One line each:
// unit | meaning | the test that fails where the value is wrong (docs/tolerances.md).
#pragma once

#include <cstddef>
#include <cstdint>

namespace gainsmith::hybrid {

constexpr double kTermRounding = 16 * 0x1p-52;  ///< of the sum of the sizes of its terms
///< | how far rounding may lead the value of a text astray
///< | LastPlaces.MoveWhatIsNoWholeNumberByUnitsOfItsTerms
constexpr double kPlain = 1e4;  ///< times the rounding
///< | what has left 0 by more is plainly no rounding
///< | ZeroCrossings.AFlightThatDrownsInTheNoiseOfAStepEndsInTime
constexpr double kLongestStep = 1.0 / 16;  ///< of the horizon
///< | no step of a careful run is longer, as what lasts less may be stepped over
///< | ZeroCrossings.WhatBranchesForLittleTimeIsCrossed
constexpr double kLongestOfPulses = 1e-3;  ///< of the horizon
///< | the same, of all runs, where the flow has pulses
///< | Campaign.IntegratedFlowsAreNoCauseOfWrongVerdicts
constexpr double kSeriesRounding = 4 * kTermRounding;  ///< of the sizes added up at a point
///< | what the last terms of a series of an exact flow may amount to
///< | EventFlow.WhatSwingsAndDiesDownAsksForNoMoreSteps
constexpr double kAddedUp = 1e-12;  ///< relative
///< | rounding that has added up over a run: of a clock at the horizon, of data beside their range,
///< of the pieces of a step
///< | Law.WhatIsOutsideByRoundingAloneIsInside
constexpr double kOneInstant = 1e-14;  ///< of the time
///< | times that differ by less are one instant
///< | EventRun.AClockAtTheEndOfAStepFiresOnce
constexpr double kHardly = 1e-9;  ///< of the horizon
///< | a time in which a run hardly advances: flows that chatter, switches that slide, what a flow
///< may be outside of `while` after a jump
///< | JudgedEnds.ChatteringMeansShortFlows
constexpr double kSlow = 1e-6;  ///< of the time so far
///< | ten thousand steps of a flow that advance less have become too short
///< | EventEnding.StepsThatHardlyAdvanceEndARun
constexpr std::size_t kAtOnce = 8;  ///< switches of a flow
///< | so many within hardly any time slide; a kink that changes so often at one time is passed over
///< | JudgedEnds.ChatteringMeansShortFlows
constexpr std::size_t kInARow = 100;  ///< flows, switches, jumps, notes
///< | so many alike in a row are no accident: a run chatters or slides; as many are named
///< | EventSwitch.ACrossingInTheRoundingIsNoSliding
constexpr std::size_t kRatios = 12;  ///< ratios of lengths
///< | so many that agree are a steady factor, however slowly the lengths shrink
///< | EventRun.ZenoStopsAtItsAccumulation
constexpr double kLeftOver = 1e-7;  ///< of the time so far
///< | jumps accumulate where no more is left and states are steady; fewer ratios than 12 make it
///< | EventEnding.AFewFlightsThatShrinkFastAccumulate
constexpr double kNothingLeft = 1e-8;  ///< of the time so far
///< | jumps accumulate where no more is left, whatever states do
///< | EventEnding.ACounterThatEndsShrinkingIsNoZeno
constexpr std::size_t kFewestRatios = 4;  ///< ratios of lengths
///< | jumps accumulate where at least so many ratios of lengths agree
///< | JudgedEnds.ZenoMeansASteadyFactor
constexpr double kSteady = 3e-3;  ///< relative
///< | a factor, a rate or a state that changes by less is steady
///< | JudgedEnds.ZenoMeansASteadyFactor
constexpr double kOfAccuracy = 1e-3;  ///< of the accuracy of the integration
///< | what matters to nothing that is integrated
///< | Judge.FindsALateJump
constexpr double kMeantEqual = 1e-9;  ///< relative
///< | numbers that a person meant to be equal: elements of a symmetric matrix
///< | EventEnding.StatesThatAreNoneOfTheirKindAreErrors
constexpr double kNearBreak = 0.02;  ///< of the largest difference on a step
///< | a text comes near to another branch where it is as near as that and turns back
///< | NarrowClaims.BranchesOfSmoothValuesAreDecided
constexpr double kLargestState = 1e150;  ///< magnitude
///< | a run of which a state is larger has diverged
///< | EventEnding.EscapesNameTheirTime
constexpr std::int64_t kMost = 1'000'000;  ///< things in one run
///< | jumps without a flow between them, passes of a loop, steps, corners of a box: more of them in a run have no end
///< | EventEnding.AChainOfJumpsWithoutFlowNamesTheEventAndItsValue

}  // namespace gainsmith::hybrid
