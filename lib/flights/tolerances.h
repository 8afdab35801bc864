// The tolerances of this room: unit | meaning | test.
#pragma once

namespace gainsmith::flights {

// clang-format off
constexpr double kErrorOfFlights = 8;  ///< differences of two runs | the error of a value of such flights |
        ///< FlightRuns.KnowWhatJumpsAmplify
constexpr double kApart = 1e-4;  ///< of the size of all terms | two runs of flights that differ by more are
        ///< left to steps | FlightRuns.KnowWhatJumpsAmplify
constexpr double kTouches = 1e-12;  ///< of the terms of a discriminant | a quadratic that comes so near to 0
        ///< may touch it | FlightRuns.LeaveToStepsWhatIsUnusual
// clang-format on

}  // namespace gainsmith::flights
