// The tolerances of this room, some of which packs share: unit | meaning | test.
#pragma once

#include <cstddef>

namespace gainsmith::linear {

// clang-format off
constexpr double kBoundSlack = 1 + 1e-9;  ///< factor | bounds of errors are summed in double
        ///< without directed rounding and then widened by this | Systems/LinearPacks.NoErrorIsBeyondItsBound
constexpr double kCoefficientNoise = 1e-80;  ///< of the largest coefficient | a coefficient in 100
        ///< digits below it is 0 | CoordinatesTest.LeaveOutWhatNoClaimDependsOn
constexpr std::size_t kMostWords = 2000;  ///< words | a text that expands to a longer polynomial is
        ///< judged as it is written | PolynomialTest.IsTheFunctionOfItsText
// clang-format on

}  // namespace gainsmith::linear
