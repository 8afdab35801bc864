// The tolerances of this room: unit | meaning | test.
#pragma once

#include <cstdint>

namespace gainsmith::verify {

// clang-format off
constexpr double kShownPlaces = 64;  ///< units in the last place | a value that changes by its own
        ///< size when all variables move by as much is rounding, and not drawn |
        ///< Replay.KnowsWhatIsRounding
constexpr std::uint64_t kSampled = 1024;  ///< runs | one of so many, or fewer (pack_judge.h), is
        ///< repeated by the careful run, whatever packs say of it | PackJudge.RepeatsSomeRunsCarefully
constexpr std::uint64_t kFewestInPacks = 8;  ///< runs | of fewer runs each is careful: some are made
        ///< carefully anyway | PackJudge.AFewRunsAreMadeOneByOne
constexpr double kDoubtful = 1000;  ///< times its error | a claim that is violated by less is to be
        ///< violated in 31 digits, too | Judge.ATieIsNotViolatedByChance
constexpr std::uint64_t kIn31Digits = 1000;  ///< runs of a campaign | so many of its first are made in 31
        ///< digits where doubles leave them open: where the truth is a tie, all are |
        ///< Judge.AsManyTiesAsRunsTakeTheirTime
constexpr double kReach = 3;  ///< standard deviations | so far a search for the worst run takes
        ///< normal noise | DrawCube.NormalNoiseReachesThreeDeviations
constexpr double kLongestList = 64;  ///< draws | so many lengths, losses or values of one noise are
        ///< chosen one by one; then they repeat | DrawCube.ListsRepeatAfterAPeriodOrAtTheirMost
// clang-format on

}  // namespace gainsmith::verify
