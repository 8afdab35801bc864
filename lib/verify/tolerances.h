// The tolerances of this room: unit | meaning | test.
#pragma once

#include <cstdint>

namespace gainsmith::verify {

// clang-format off
constexpr double kAccuracyOfMany = 1e-8;  ///< relative, and absolute | the runs of a campaign are
        ///< integrated to it unless the campaign asks for another accuracy |
        ///< Campaign.IntegratedFlowsAreNoCauseOfWrongVerdicts
constexpr double kAccuracyOfOne = 1e-10;  ///< relative, and absolute | a run that is shown, or
        ///< repeated because a claim is undecided | Campaign.FlowsThatAreNotAffineAreIntegrated
constexpr double kSharper = 1e-2;  ///< of the accuracy | the accuracy of the second run, whose
        ///< difference from the first one shows the error |
        ///< Campaign.IntegratedFlowsAreNoCauseOfWrongVerdicts
constexpr int kSamplesBeside = 2;  ///< samples on each side | the difference of two runs at a
        ///< sample is the largest among these, since the runs may cross |
        ///< Campaign.IntegratedFlowsAreNoCauseOfWrongVerdicts
constexpr double kLeastRise = 1e-3;  ///< of the accuracy, of the value | a smaller rise of a value
        ///< that must not increase is sought only at the samples |
        ///< FasterThanTheSteps/NarrowClaims.AreJudgedAsTheyAre
constexpr double kBeforeEnd = 1.0/64;  ///< of the last step | the rate of a guard at an event is
        ///< that over this part of the step |
        ///< EventDoubts.AnOrderWithinTheErrorThatMattersIsUncertain
constexpr double kShownPlaces = 64;  ///< units in the last place | a value that changes by its own
        ///< size when all variables move by as much is rounding, and not drawn |
        ///< Replay.KnowsWhatIsRounding
constexpr std::uint64_t kSampled = 1024;  ///< runs | one of so many, or fewer (pack_judge.h), is
        ///< repeated by the careful run, whatever packs say of it | PackJudge.RepeatsSomeRunsCarefully
constexpr std::uint64_t kFewestInPacks = 8;  ///< runs | of fewer runs each is careful: some are made
        ///< carefully anyway | PackJudge.AFewRunsAreMadeOneByOne
constexpr double kReach = 3;  ///< standard deviations | so far a search for the worst run takes
        ///< normal noise | DrawCube.NormalNoiseReachesThreeDeviations
constexpr double kLongestList = 64;  ///< draws | so many lengths, losses or values of one noise are
        ///< chosen one by one; then they repeat | DrawCube.ListsRepeatAfterAPeriodOrAtTheirMost
// clang-format on

}  // namespace gainsmith::verify
