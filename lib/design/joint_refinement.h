// Joint refinement, the last step of an outer search: scalars and unknowns are moved together.
//
// Over v = (s, x, L_1, L_2, ...) with s the scalars (as fractions of their ranges), x the unknowns
// and L_k lower triangular:
//   minimise   the figure: c(s)'x + c_0(s), or a scalar of s itself
//   subject to B_k(s, x) - shift_k I = L_k L_k'  for every block k,   0 <= s <= 1,   (L_k)_ii >= 0
// A block is positive semidefinite exactly when it has such a factor, so this smooth program is the
// design problem, bilinear in s and x. B_k is affine in x: derivatives in x are its coefficients,
// those in s are central differences, those in L_k are analytic.
//
// The answer is only a proposal for s: the ordinary synthesis decides whether it is kept.
#pragma once

#include <optional>
#include <string>

#include "design/search_request.h"
#include "model/gains.h"
#include "search/optimizers.h"

namespace gainsmith::design {

struct Proposal {
  std::optional<model::Overrides> scalars;  ///< none when there is no smooth program
  std::string cause;                        ///< why the solver stopped, or why there is no program
};

/// From the gains of the request's best point to a nearby point that the smooth program prefers:
/// values of request.over and request.extreme. None when the figure is the margin, is not affine in
/// the unknowns, or when the inequalities change their number or sizes near the point.
Proposal refine_jointly(const model::Instance& own, const SearchRequest& request,
                        const model::Gains& gains, const search::SmoothSolver& solver);

}  // namespace gainsmith::design
