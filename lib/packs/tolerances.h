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
constexpr int kMostSteps = 20000;  ///< steps in one flow | the same of a longer one |
        ///< UnusualRuns.AreLeftOpen
constexpr int kMostLooks = 1000;  ///< looks at one instant | a chain of more jumps, or a flow whose
        ///< branches change without end, is left to the careful run | UnusualRuns.AreLeftOpen
constexpr int kMostHalvings = 4;  ///< times | a step is halved so often where a sign is not certain
        ///< on it | UnusualRuns.AreLeftOpen
constexpr double kScore = 0.02;  ///< relative, and absolute | how near a run comes to its bound is known
        ///< so well, or it is left to the careful run | Systems/PackRuns.AgreeWithCarefulRuns
constexpr double kFlatRoot = 0.25;  ///< of the largest operand on a step | a square root whose operand
        ///< falls below is not followed by a polynomial | SharpClaims.AreDecidedRight
constexpr double kAtRoot = 1e-11;  ///< of the horizon | a step ends at a root that is so near |
        ///< Systems/PackRuns.AgreeWithCarefulRuns
constexpr int kMostLengthDegree = 96;  ///< degree | functions of a length that no polynomial of it
        ///< follows are not run as linear packs | LengthTable.RefusesWhatItDoesNotFollow
constexpr double kLengthTail = 1e-25;  ///< of the largest coefficient | the last quarter of the
        ///< coefficients is below, so that what no coefficient shows is rounding |
        ///< LengthTable.RefusesWhatItDoesNotFollow
constexpr double kLengthRest = 1e-14;  ///< of the largest coefficient | what a polynomial may leave out,
        ///< which is part of all bounds | Systems/LinearPacks.NoErrorIsBeyondItsBound
constexpr double kLengthNoise = 1e-70;  ///< of the largest coefficient of all functions | a function
        ///< below is the rounding of 0 | LengthTable.WhatIsRoundingIsNothing
constexpr double kLengthFaded = 1e-40;  ///< of the largest coefficient of all functions | a function
        ///< below is 0 up to its size: that of a fast mode | Systems/LinearPacks.NoErrorIsBeyondItsBound
constexpr double kLongestPiece = 30;  ///< the norm of the matrix times the length | functions of
        ///< longer flows have other polynomials next to their start | Systems/LinearPacks.NoErrorIsBeyondItsBound
constexpr double kLongestFlow = 1e9;  ///< the norm of the matrix times the length | longer flows are
        ///< not run as linear packs | LinearPacks.RunWhatTheyCan
constexpr double kFlowMargin = 1e-9;  ///< relative | that a value falls along flows is shown in
        ///< double with so much to spare | LinearProof.NeedsMoreThanRounding
constexpr double kMostGrowth = 4;  ///< factor | errors of linear runs are bounded for all flows
        ///< of a block at once, which may grow the bounds so much |
        ///< LinearPacks.FollowWhatFallsWhereFlowsMayGrow
constexpr std::int64_t kMostFlowsOfBlock = 16;  ///< flows | and is no longer than so many |
        ///< Systems/LinearPacks.NoErrorIsBeyondItsBound
// clang-format on

}  // namespace gainsmith::packs
