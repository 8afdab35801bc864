// Internal to the judge (judge.h): what a run draws, drawn again from the definition of the
// streams.
//
//   u(p, i, k)   draw k of the stream of the run whose key is Philox4x32-10 of (p, i, 0, 0) under
//                the seed; p = 1 start, 2 first, 3 length, 4 lost, 5 noise; i: the variable, event
//                or noise
//   start        box: low + (high - low) u, one draw an element, of symmetric states of the lower
//                triangle; list: element `run` modulo their number
//   first        low + (high - low) u
//   length k     by law `run` modulo their number; those of an event count before those of all
//   lost k       u < probability, and not more than `in_a_row` one after the other
//   noise k      uniform: low + (high - low) u; normal: c + M z, lognormal: c .* exp(M z), with
//                z = sqrt(-2 log(1 - u)) cos(2 pi v), two draws an element; M the deviations or the
//                lower factor of the covariance, a column whose pivot is rounding being 0
//   start        normal and lognormal: as noise 0
//
// Occurrences that `if` spends leave no jump: their lengths and drawings are passed over.
#pragma once

#include "hybrid/trajectory.h"
#include "judge/faults.h"
#include "judge/texts.h"

namespace gainsmith::judge {

/// A fault for each start, length, loss and noise of the run that is not its draw, up to kRounding
/// of its size. `from`: the seed, the run and its campaign.
void check_draws(Texts& texts, const hybrid::Trajectory& trajectory, const DrawnFrom& from,
                 Faults& faults);

}  // namespace gainsmith::judge
