// The tolerances of this room: unit | meaning | test.
#pragma once

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
constexpr double kLastRelative = 1e-4;  ///< times the accuracy of the careful run, relative |
        ///< packs are integrated to it where both others leave a run open, as where small errors grow |
        ///< Systems/PackRuns.AgreeWithCarefulRuns
constexpr double kLastAbsolute = 1e-8;  ///< times the accuracy of the careful run, absolute | the same |
        ///< Systems/PackRuns.AgreeWithCarefulRuns
constexpr double kMoved = 0x1p-50;  ///< relative | the second run is moved by up to it at jumps and, where
        ///< flights are in closed form, after each | FlightRuns.KnowWhatJumpsAmplify
constexpr double kFirstStep = 1e-3;  ///< of the horizon | the first step of a run |
        ///< Systems/PackRuns.AgreeWithCarefulRuns
constexpr double kShortestStep = 1e-10;  ///< of the horizon | a run with a shorter step is left to the
        ///< careful one | UnusualRuns.AreLeftOpen
constexpr int kMostSteps = 20000;  ///< steps in one flow | the same of a longer one |
        ///< UnusualRuns.AreLeftOpen
constexpr int kMostAtOneInstant = 1000;  ///< evaluations at one instant | a chain of more jumps, or a flow whose
        ///< branches change without end, is left to the careful run | UnusualRuns.AreLeftOpen
constexpr int kMostHalvings = 4;  ///< times | a step is halved so often where a sign is not certain
        ///< on it | UnusualRuns.AreLeftOpen
constexpr double kKinkInside = 0.01;  ///< of a step | a step with too large an error goes up to a kink
        ///< that is so far from both ends | Systems/PackRuns.AgreeWithCarefulRuns
constexpr double kBesideKink = 1e-4;  ///< of a step | a step ends so near to a kink of a claim |
        ///< SharpClaims.KinksAreLeftToNoCarefulRun
constexpr double kScore = 0.02;  ///< relative, and absolute | how near a run comes to its bound is known
        ///< so well, or it is left to the careful run | Systems/PackRuns.AgreeWithCarefulRuns
constexpr double kFlatRoot = 0.25;  ///< of the largest operand on a step | a square root whose operand
        ///< falls below is not followed by a polynomial | SharpClaims.AreDecidedRight
constexpr double kAtRoot = 1e-11;  ///< of the horizon | a step ends at a root that is so near |
        ///< Systems/PackRuns.AgreeWithCarefulRuns
// clang-format on

}  // namespace gainsmith::packs
