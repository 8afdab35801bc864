// The tolerances of this room, some of which packs share: unit | meaning | test.
#pragma once

#include <cstddef>
#include <cstdint>

namespace gainsmith::linear {

// clang-format off
constexpr double kBoundSlack = 1 + 1e-9;  ///< factor | bounds of errors are summed in double
        ///< without directed rounding and then widened by this | Systems/LinearPacks.NoErrorIsBeyondItsBound
constexpr double kCoefficientNoise = 1e-80;  ///< of the largest coefficient | a coefficient in 100
        ///< digits below it is 0 | CoordinatesTest.LeaveOutWhatNoClaimDependsOn
constexpr std::size_t kMostWords = 2000;  ///< words | a text that expands to a longer polynomial is
        ///< judged as it is written | PolynomialTest.IsTheFunctionOfItsText
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
constexpr std::size_t kMostPeakRank = 12;  ///< numbers behind a jump | with more of them and a claim
        ///< `below` steps make 1,000 runs before the tables are ready | LinearPacks.RunWhatTheyCan
// clang-format on

}  // namespace gainsmith::linear
