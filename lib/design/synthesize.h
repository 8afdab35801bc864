// From a problem to gains.
#pragma once

#include "model/gains.h"
#include "model/instance.h"
#include "sdp/solver.h"

namespace gainsmith::design {

/// Compiles the method's inequalities for the instance, solves them and reads the gains back.
///
/// verdict yes: every inequality holds at the matrices as written (margins recomputed in double),
/// the solver
///   said optimal, and strict inequalities keep the margin that was asked for up to 1 %.
/// verdict no: a Farkas certificate that was checked on the raw data excludes every solution with
/// entries below
///   1e12 times the size that the data set (of a homogeneous problem: with a relative margin above
///   1e-12); it is stored with its multipliers. When only the gain bound makes it so, the message
///   says so.
/// verdict undecided: neither, with the cause. Then no gains are given but those that the method
/// takes as
///   data.
///
/// Gains that depend on data alone (an analysis) are written whatever the verdict. InputError for
/// what cannot be compiled.
model::Gains synthesize(const model::Instance& instance, const sdp::Options& options);

/// The semidefinite program that synthesize() solves first (see lmi/formulation.h).
sdp::Problem semidefinite_program(const model::Instance& instance);

}  // namespace gainsmith::design
