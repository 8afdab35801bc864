// From an instance to gains.
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
