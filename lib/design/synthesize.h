// From an instance of a design problem to gains.
//
// An instance states inequalities B_k(x, t) > 0 or >= 0, for all t of a domain, in unknown matrices
// whose scalars are x, with data as numbers. Gains are formulas in the unknowns, such as
// L = inv(P)*Y. This folder asks the solver and says yes, no or undecided:
//   synthesis   synthesize.h; its programs and their order in attempts.h, one program in attempt.h,
//               a point near a minimum in minimum.h, certificates in certificates.h
//   equations   facial_reduction.h; squares of polynomials in sums_of_squares.h; quotients of
//               matrices in quotient.h
//   scalars     that no program can have as unknowns: bisect.h, scan.h, optimize.h
//   reasons     explain.h, elastic.h, limits.h; modes that no gain moves in hautus.h
//   gains       their values in gain_values.h, those of others in fixed_gains.h
// The formulation follows Boyd, El Ghaoui, Feron & Balakrishnan, Linear Matrix Inequalities in
// System and Control Theory, 1994. What a yes and a no prove is said in verdict/rational_blocks.h.
#pragma once

#include "model/gains.h"
#include "model/instance.h"
#include "sdp/solver.h"

namespace gainsmith::design {

/// Poses the inequalities of the instance, makes the attempts that are due (attempts.h) and reads
/// the gains back.
///
/// verdict yes: every inequality holds at the matrices as written, for all values of its variables.
/// verdict no: a certificate that was checked on the decimals of the file excludes every solution
/// of the inequalities, of any size, without margins or bounds (verdict/refutation.h); it is stored
/// with its multipliers. verdict undecided: neither, with what is known. Then only the gains whose
/// formulas use nothing but data are given.
///
/// A method without unknowns and inequalities is a design by formula: its gains are evaluated.
///
/// InputError for what cannot be posed.
enum class Depth {
  thorough,
  verdict,  ///< the same verdict and point, but for a table of many points: margins only as far as
            ///< the verdict rests on them, and no limits of gains
  quick     ///< leaves undecided what double does not decide: the questions of an outer search
};
model::Gains synthesize(const model::Instance& instance, const sdp::Options& options,
                        Depth depth = Depth::thorough);

/// synthesize() with other values for some scalars.
model::Gains synthesize_at(const model::DesignPtr& design, const model::Overrides& overrides,
                           const sdp::Options& options, Depth depth = Depth::thorough);

}  // namespace gainsmith::design
