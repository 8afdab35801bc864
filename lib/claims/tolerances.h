// The tolerances of this room, some of which verify shares: unit | meaning | test.
#pragma once

namespace gainsmith::claims {

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
constexpr int kPartsOfFlow = 32;  ///< parts | claims are compared at the ends of so many equal
        ///< parts of an integrated flow | FasterThanTheSteps/NarrowClaims.AreJudgedAsTheyAre
constexpr double kErrorOfDifference = 4;  ///< factor | the error of the sharper of two runs, of
        ///< their difference | Campaign.IntegratedFlowsAreNoCauseOfWrongVerdicts
constexpr double kErrorOfRounding = 64;  ///< factor | the same, where flows are exact: what rounding
        ///< makes of two runs may nearly cancel | ClaimsAlongRuns.WhatRoundingMakesMayNearlyCancel
constexpr double kFloorOfAccuracy = 1e-4;  ///< of the accuracy | nothing below so much of the value
        ///< at the start is compared where flows are integrated |
        ///< Noise.ACertainRiseCountsDownToAPartOfTheAccuracy
constexpr double kNoiseOfRuns = 1e-8;  ///< of the value at the start | what is undecided below it
        ///< counts for nothing where flows are integrated, however accurately |
        ///< Noise.WhatIsUndecidedIsLeftOutAlikeAtAllAccuracies
constexpr double kGrown = 0.1;  ///< of the error | at a sample that may lie at the one before, a
        ///< value counts as grown only beyond it |
        ///< Noise.WithinAnInstantAValueHasGrownBeyondAPartOfItsError
constexpr double kAgreement = 1e-6;  ///< of the range of a value on a part | a series agrees with
        ///< the value, when it only locates something |
        ///< FasterThanTheSteps/NarrowClaims.AreJudgedAsTheyAre
constexpr double kExactAgreement = 1e-10;  ///< of the range of a value on a part | a series agrees
        ///< with the value, when its own values count |
        ///< Measures.FollowTextsThatAreFasterThanTheSteps
constexpr double kValueRounding = 1e-13;  ///< relative | the rounding of a value along a run, and
        ///< of two orders of maps that lead to the same state |
        ///< NarrowClaims.WhatIsTrueIsNeverViolated
constexpr double kBesideJump = 1e-5;  ///< of a part | samples on both sides of a jump of a value
        ///< lie so far from it, since two runs jump at different times |
        ///< Jumps/NarrowClaims.AreJudgedAsTheyAre
constexpr double kBesideBreak = 1e-11;  ///< of half a part | a series takes no value at a break
        ///< itself, where a sign is 0 | Jumps/NarrowClaims.AreJudgedAsTheyAre
constexpr int kMostEvaluations = 1500;  ///< evaluations on a step | a text that no series agrees with
        ///< after these is left as it is | FasterThanTheSteps/NarrowClaims.AreJudgedAsTheyAre
constexpr double kFarBranch = 1000;  ///< errors | a branch is certain that lies farther away, by an
        ///< estimate that costs less than a bound |
        ///< NarrowClaims.BranchesWithoutAnErrorBoundAreDecidedWhereTheyAreFar
constexpr double kInstantOfRun = 1e-6;  ///< of the time of a run | flows that add up to less lie
        ///< within an instant, and two runs that end so near each other end together |
        ///< TwinParts.EventsThatLieApartAreNotExchanged
constexpr double kParted = 1e-3;  ///< of the range of a value so far | two runs that differ by more
        ///< have parted, and nothing is known of the value from there on |
        ///< ClaimsAlongRuns.TwoRunsThatHavePartedSayNothingMore
constexpr double kPartedAccuracy = 1e3;  ///< of the accuracy, of the terms of a value | two runs
        ///< have not parted whose difference is less |
        ///< ClaimsAlongRuns.TwoRunsThatHavePartedSayNothingMore
constexpr double k31Error = 1e-28;  ///< of the largest value so far | what a run in 31 digits is off
        ///< by at least, where its twin may agree with it by chance | Judge.ATieIsNotViolatedByChance
// clang-format on

}  // namespace gainsmith::claims
