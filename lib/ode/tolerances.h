// What decides where functions of time are integrated and searched for roots. One line each:
// unit | meaning | the test that fails where the value is wrong (docs/tolerances.md).
#pragma once

namespace gainsmith::ode {

constexpr double kFar = 4;  ///< times what a function changes by over a step
///< | farther from 0 at the ends and the middle, it has no root on the step
///< | StepRange.IsNotFarWhereAPairOfRootsMayBe
constexpr double kFinest = 1e-13;  ///< relative
///< | the least error that double precision is asked for: of interpolants, of integrations, of a time
///< | Roots.RandomPolynomialsAndWavesHaveAllTheirRoots
constexpr double kTurnsNear = 1e-10;  ///< of the largest value on a step
///< | turning points as near to 0 as that are reported
///< | Roots.WhatComesNearWithoutReachingIsNoted
constexpr int kPatience = 10000;  ///< attempts at one place
///< | points of a function on a step, steps of one flow, steps that hardly advance,
///< draws: more are not made
///< | Roots.OfMoreThanCanBeSearchedNotAllAreSought
constexpr double kEscape = 1e4;  ///< times the start, and what the flow does at its first rate
///< | a flow that has grown by this while its steps fall to nothing escapes
///< | JudgedEnds.EscapedMeansLargeOrAtOnce
constexpr double kWithin = 0.25;  ///< times what a polynomial's rate is off
///< | the error of the polynomial of a step, by its rate at 0.6 of the step
///< | Integrator.IsAsAccurateWithinStepsAsAtTheirEnds
constexpr double kShorter = 0.6;  ///< times the longest step
///< | the longest one of a run that is repeated with smaller errors
///< | Campaign.IntegratedFlowsAreNoCauseOfWrongVerdicts
constexpr double kManySteps = 1000;  ///< steps of one flow
///< | a flow is stiff that needs so many more in steps as long as stability or noise permits
///< | EventFlow.VeryStiffFlowsDoNotStandStill
constexpr int kMostIterations = 40;  ///< iterations
///< | what solves the stages of a Gauss step takes no more
///< | Gauss.FollowsStiffFlows
constexpr double kSolved = 0.01;  ///< of the tolerance
///< | the error to which implicit steps are solved: stages of Gauss, BDF
///< | Gauss.KeepsTheEnergyOfAnOscillator

}  // namespace gainsmith::ode
