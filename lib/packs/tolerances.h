// The tolerances of this room: unit | meaning | test.
#pragma once

#include <cstdint>

namespace gainsmith::packs {

// clang-format off
constexpr double kFirstRelative = 100;  ///< times the accuracy of the careful run, relative |
        ///< packs are integrated to it first | Systems/PackRuns.AgreeWithCarefulRuns
constexpr double kFirstAbsolute = 1;  ///< times the accuracy of the careful run, absolute | the same |
        ///< Systems/PackRuns.AgreeWithCarefulRuns
constexpr double kAgainRelative = 0.1;  ///< times the accuracy of the careful run, relative |
        ///< packs are integrated to it where the first accuracy leaves a run open |
        ///< Systems/PackRuns.AgreeWithCarefulRuns
constexpr double kAgainAbsolute = 1e-4;  ///< times the accuracy of the careful run, absolute | the same:
        ///< errors of observers decay | Systems/PackRuns.AgreeWithCarefulRuns
constexpr double kErrorOfPair = 4;  ///< differences of two runs | the error of a value |
        ///< Systems/PackRuns.AgreeWithCarefulRuns
constexpr double kFirstStep = 1e-3;  ///< of the horizon | the first step of a run |
        ///< Systems/PackRuns.AgreeWithCarefulRuns
constexpr double kShortestStep = 1e-10;  ///< of the horizon | a run with a shorter step is left to the
        ///< careful one | UnusualRuns.AreLeftOpen
constexpr std::int64_t kMostSteps = 20'000;  ///< steps | the same of a longer run |
        ///< UnusualRuns.AreLeftOpen
constexpr int kMostChain = 64;  ///< jumps without a flow between them | the same of a longer chain |
        ///< UnusualRuns.AreLeftOpen
constexpr int kMostHalvings = 4;  ///< times | a step is halved so often where a sign is not certain
        ///< on it | UnusualRuns.AreLeftOpen
constexpr double kAtRoot = 1e-11;  ///< of the horizon | a step ends at a root that is so near |
        ///< Systems/PackRuns.AgreeWithCarefulRuns
constexpr int kMostShortFlows = 3;  ///< flows in a row | more of them within an instant are left to
        ///< the careful run | UnusualRuns.AreLeftOpen
// clang-format on

}  // namespace gainsmith::packs
