// From an instance to gains.
#pragma once

#include "model/gains.h"
#include "model/instance.h"
#include "sdp/problem.h"
#include "sdp/solver.h"

namespace gainsmith::design {

/// Poses the inequalities of the instance, climbs the ladder of attempts (ladder.h) and reads the
/// gains back.
///
/// verdict yes: the solver converged, every inequality holds at the matrices as written (margins
/// recomputed in double, exchanges bounded between their points), and strict ones keep the margin
/// that was asked for up to 1 %.
/// verdict no: a Farkas certificate that was checked on the program's data excludes every solution
/// that keeps the margin and has entries below 1e12 times the size that the data set (of a
/// homogeneous problem: every solution with a relative margin above 1e-12); it is stored with its
/// multipliers. When only the gain bound makes it so, the message says so.
/// verdict undecided: neither, with the cause. Then only the gains whose formulas use nothing but
/// data are given.
///
/// InputError for what cannot be posed.
model::Gains synthesize(const model::Instance& instance, const sdp::Options& options);

/// synthesize() with other values for some scalars.
model::Gains synthesize_at(const model::DesignPtr& design, const model::Overrides& overrides,
                           const sdp::Options& options);

/// The semidefinite program that synthesize() solves first (see lmi/formulation.h).
sdp::Problem semidefinite_program(const model::Instance& instance);

}  // namespace gainsmith::design
