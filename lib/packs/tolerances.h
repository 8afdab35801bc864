// The tolerances of this room: unit | meaning | test.
#pragma once

#include <cstdint>

#include "packs/pack_system.h"

namespace gainsmith::packs {

// clang-format off
constexpr PackAccuracy kAccuracies[] = {{100, 1}, {0.1, 1e-4}};  ///< times those of a careful run |
        ///< packs are integrated to the first, and once more to the second where they leave a run
        ///< open | PackRuns.AgreeWithCarefulRuns
constexpr double kErrorOfPair = 4;  ///< differences of two runs | the error of a value |
        ///< PackRuns.AgreeWithCarefulRuns
constexpr double kFirstStep = 1e-3;  ///< of the horizon | the first step of a run |
        ///< PackRuns.AgreeWithCarefulRuns
constexpr double kShortestStep = 1e-10;  ///< of the horizon | a run with a shorter step is left to the
        ///< careful one | PackRuns.LeaveOpenWhatIsUnusual
constexpr std::int64_t kMostSteps = 20'000;  ///< steps | the same of a longer run |
        ///< PackRuns.LeaveOpenWhatIsUnusual
constexpr int kMostChain = 64;  ///< jumps without a flow between them | the same of a longer chain |
        ///< PackRuns.LeaveOpenWhatIsUnusual
constexpr int kMostHalvings = 4;  ///< times | a step is halved so often where a sign is not certain
        ///< on it | PackRuns.LeaveOpenWhatIsUnusual
// clang-format on

}  // namespace gainsmith::packs
